"""Which failures a known mistake explains: those of the checks that known submissions with that mistake fail."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files

from course.grading.checks.check import Check


def explains(module: str, check: Check, mistake: str) -> bool:
    """Whether who makes that mistake fails this check for it.

    Parameters
    ----------
    mistake : its name; one that nobody has recorded explains all that fails
    """
    checks = _recorded().get(f"{module}.{check.function}/{mistake}")
    return checks is None or check.name in checks


@cache
def _recorded() -> dict[str, list[str]]:
    """What ``python -m benchmarks.mutants --record`` has found."""
    path = files("course.grading") / "data" / "explained.json"
    found: dict[str, list[str]] = json.loads(path.read_text(encoding="utf-8"))
    return found
