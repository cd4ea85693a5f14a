"""Changes of a student's code: one place each, in the student's own lines, and still Python."""

import ast

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.release.stubs import make_stub
from course.school.grading.viva.changes import changes
from tests.lengths import share

SOURCE = '''\
"""Å module."""
import numpy as np


def disk(u, radius):
    if radius < 2 * 0:
        raise ValueError(f"{radius - 1}")
    r = radius * np.sqrt(u[0])  # ü - 2 * 3
    phi = 2 * np.pi * u[1]
    return _polar(r, phi)


def _polar(r, phi):
    return np.stack((r * np.cos(phi), r * np.sin(phi)))


def _unused(a):
    return -a


def angle(y, x):
    return (0.5 +
            np.arctan2(y, x) ** 2)
'''


def found(source: str = SOURCE, given: str = "") -> dict[str, list[tuple[int, str, str]]]:
    of: dict[str, list[tuple[int, str, str]]] = {}
    for one in changes(source, ("disk", "angle"), given):
        of.setdefault(one.function, []).append((one.line, one.kind, one.after))
    return of


def test_each_place_that_may_slip_is_changed() -> None:
    disk = found()["disk"]
    assert (8, "root", "r = radius * u[0]  # ü - 2 * 3") in disk
    assert (8, "factor", "r = np.sqrt(u[0])  # ü - 2 * 3") in disk
    assert (8, "order", "r = radius * np.sqrt(u[1])  # ü - 2 * 3") in disk
    assert (9, "factor", "phi = np.pi * u[1]") in disk
    assert (9, "factor", "phi = 2 * u[1]") in disk
    assert (9, "constant", "phi = 4 * np.pi * u[1]") in disk
    # A private function belongs to the one that calls it.
    assert (14, "order", "return np.stack((r * np.sin(phi), r * np.cos(phi)))") in disk
    assert (14, "function", "return np.stack((r * np.sin(phi), r * np.sin(phi)))") in disk
    angle = found()["angle"]
    assert (23, "order", "np.arctan2(x, y) ** 2)") in angle
    assert (23, "power", "np.arctan2(y, x))") in angle
    assert (22, "sign", "return (0.5 -") in angle


def test_nothing_else_is_touched() -> None:
    for one in changes(SOURCE, ("disk", "angle"), ""):
        lines, before = one.source.splitlines(), SOURCE.splitlines()
        assert len(lines) == len(before)
        different = [
            n for n, pair in enumerate(zip(before, lines, strict=True), 1) if len(set(pair)) > 1
        ]
        assert different == [one.line]
        assert (
            before[one.line - 1].strip() == one.before != one.after == lines[one.line - 1].strip()
        )
        assert ast.parse(one.source)
        # What is refused, said and not called stays.
        assert one.line not in (1, 6, 7, 18)


def test_lines_of_the_stub_are_left_alone() -> None:
    assert {line for line, *_ in found(given="    phi = 2 * np.pi * u[1]\n")["disk"]} == {8, 14}


@pytest.mark.parametrize("source", ["def disk(:", "\0", "", "x = " + "(" * 500 + "1" + ")" * 500])
def test_what_is_not_python_has_no_changes(source: str) -> None:
    assert found(source) == {}


@pytest.mark.parametrize("module", share([*COURSE], 3))
def test_every_function_of_the_course_can_be_asked_about(module: str) -> None:
    path = PROJECT / "solutions" / f"{module}.py"
    source = path.read_text(encoding="utf-8")
    stub = make_stub(source, module, path.name).text
    asked = {one.function for one in changes(source, COURSE[module], stub)}
    # Two of the course's functions are one comparison, or call another one.
    assert len(set(COURSE[module]) - asked) <= 2
