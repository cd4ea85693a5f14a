"""The contracts that the renderer holds functions to: those that are declared, and kept by the course's own."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.engine.functions.contracts import contract
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.guard import Guard
from course.engine.functions.signatures import CONTRACTS
from course.school.grading.checks.declare import Function, declaration
from course.school.grading.checks.drawing import Draw

SOLUTIONS = Effects(PROJECT / "solutions")


def declared(path: str) -> Function:
    """What the checks know of a function."""
    found = declaration(*path.split("."))
    assert found is not None
    return found


def arguments(path: str, seed: int, n: int) -> list[Any]:
    """Legal arguments as the renderer has them, new ones for each call."""
    made = declared(path).make(Draw(np.random.default_rng(seed), n, np.float32)).values()
    if not contract(path).several:
        return list(made)
    return [[part.astype(np.float32) for part in a] if isinstance(a, tuple) else a for a in made]


@pytest.mark.parametrize("path", CONTRACTS)
def test_are_kept_by_the_solutions(path: str) -> None:
    """Nothing that the course's own functions return is refused, converted or changed."""
    module, name = path.split(".")
    original = SOLUTIONS.function(module, name)
    guarded = Guard(path, original, PROJECT / "solutions" / f"{module}.py")
    for seed in range(5):
        for n in (0, 1, 7, 300):
            expected, value = (call(*arguments(path, seed, n)) for call in (original, guarded))
            several = isinstance(expected, tuple | list)
            for mine, theirs in zip(
                *((value, expected) if several else ([value], [expected])), strict=True
            ):
                assert mine.dtype == theirs.dtype
                np.testing.assert_array_equal(mine, theirs)


def test_solutions_are_called_as_they_are(tmp_path: Path) -> None:
    """The course's own functions pay nothing for being looked at; copies of them do."""
    (tmp_path / "glossy.py").write_text((PROJECT / "solutions" / "glossy.py").read_text())
    assert not isinstance(SOLUTIONS.function("glossy", "keep_above"), Guard)
    assert isinstance(Effects(tmp_path).function("glossy", "keep_above"), Guard)
