"""References for whatever is asked, and no solution loaded that nobody needs."""

from pathlib import Path

import numpy as np
import pytest

from course.effects import EffectError
from course.grading import references as place
from course.grading.catalog import module_checks
from course.grading.checks.check import Caller, Check
from course.grading.references import reference, references


def checks(module: str, *, prepared: bool) -> list[Check]:
    return [c for c in module_checks(module).checks if (c.prepare is not None) == prepared]


def test_solutions_are_loaded_when_they_are_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    loaded = []

    def loading(module: str) -> Caller:
        loaded.append(module)
        return reference(module)

    monkeypatch.setattr(place, "reference", loading)
    find = references(0)
    assert loaded == []
    # Closed forms need no solution.
    assert find("thin_lens", checks("thin_lens", prepared=False)[0]) == {}
    assert loaded == []
    check = checks("thin_lens", prepared=True)[0]
    arrays = find("thin_lens", check)
    assert arrays
    assert all(np.isfinite(array).all() for array in arrays.values())
    assert find("thin_lens", check) is arrays
    assert loaded == ["thin_lens"]


def test_a_solution_that_is_missing_is_missed_where_it_is_needed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(place, "SOLUTIONS", tmp_path)
    find = references(0)
    assert find("motion_blur", checks("motion_blur", prepared=False)[0]) == {}
    with pytest.raises(EffectError, match="motion_blur"):
        find("motion_blur", checks("motion_blur", prepared=True)[0])
