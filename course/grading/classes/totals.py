"""What an assignment of some modules is worth."""

from __future__ import annotations

from collections.abc import Sequence
from math import fsum

from course.grading.catalog import module_checks
from course.grading.classes.job import with_whole


def totals(modules: Sequence[str]) -> dict[str, float]:
    """Module -> the points of its checks, that of all modules together among them where it is made."""
    return {
        module: fsum(check.points for check in module_checks(module).checks)
        for module in with_whole(modules)
    }
