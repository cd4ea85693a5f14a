"""References for whatever is asked, and no solution loaded that nobody needs."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.base.errors import CourseError
from course.base.inputs import read_arrays
from course.engine.functions.effects import EffectError
from course.school.grading import references as place
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Caller, Check
from course.school.grading.references import make_references, read_references, reference, references


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


def test_of_a_file_only_the_arrays_of_one_module_are_unpacked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "references.npz"
    make_references(("motion_blur", "thin_lens"), 0, path)
    every, read = read_references(path, 0), []

    def reading(file: Path, what: str, wanted: Callable[[str], bool]) -> dict[str, Any]:
        arrays = read_arrays(file, what, wanted)
        read.extend(arrays)
        return arrays

    monkeypatch.setattr(place, "read_arrays", reading)
    one = read_references(path, 0, "thin_lens")
    assert {name.partition(".")[0] for name in read} == {"thin_lens", "seed"}
    check = checks("thin_lens", prepared=True)[0]
    assert every("thin_lens", check)
    for name, array in every("thin_lens", check).items():
        assert np.array_equal(one("thin_lens", check)[name], array)
    with pytest.raises(CourseError, match="no references for motion_blur"):
        one("motion_blur", checks("motion_blur", prepared=True)[0])
