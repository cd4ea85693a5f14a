"""Known wrong submissions as edits of the solution: what is changed, and what is refused by name."""

from pathlib import Path

import pytest

from course.base.errors import CourseError
from course.school.grading.known import known

SOLUTION = """import numpy as np


def twice(x):
    if x < 0:
        raise ValueError("x is negative")
    ### BEGIN SOLUTION
    return 2 * x
    ### END SOLUTION


def half(x):
    return _part(x, 2)


def _part(x, by):
    for _ in range(1):
        x = x / by
    return x
"""
WRONG = """half:
  third:
    about: By three.
    caught_by: value
    mistake: by-three
    says: You divide by three.
    edits:
      - {was: "return _part(x, 2)", now: "return _part(x, 3)"}
  doubled:
    about: The other way.
    caught_by: value
    edits:
      - {in: _part, was: x = x / by, now: x = more(x) * by}
    also: |
      def more(x):
          return x
twice:
  unchecked:
    about: Takes what is negative.
    caught_by: refusals
    edits:
      - was: |
          if x < 0:
              raise ValueError("x is negative")
"""


def folder(path: Path, wrong: str = WRONG) -> Path:
    (path / "film.py").write_text(SOLUTION, encoding="utf-8")
    (path / "wrong").mkdir()
    (path / "wrong" / "film.yaml").write_text(wrong, encoding="utf-8")
    return path


def test_lines_are_changed_and_the_rest_is_the_solution(tmp_path: Path) -> None:
    found = {}
    for each in known("film", folder(tmp_path)):
        assert not each.right
        exec(each.source, module := {})
        found[each.name] = module
    assert list(found) == ["doubled", "third", "unchecked"]
    assert [found[name]["half"](6) for name in found] == [12, 2, 3]
    assert found["unchecked"]["twice"](-1) == -2
    with pytest.raises(ValueError, match="negative"):
        found["third"]["twice"](-1)
    third = known("film", tmp_path)[1]
    told = third.about, third.function, third.caught_by, third.mistake, third.says
    assert told == ("By three.", "half", "value", "by-three", "You divide by three.")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "was: x = x / by",
            "was: x = x / bye",
            r"half\.doubled: 'x = x / bye' stands 0 times in _part",
        ),
        ("in: _part", "in: part", r"half\.doubled: the solution has no function part"),
        ('was: "return _part(x, 2)"', 'was: ""', "stands 0 times in half"),
        ("mistake: by-three", "mistakes: by-three", "unknown field `mistakes`"),
        ("    about: By three.\n", "", "missing required field `about`"),
        ("half:", "half: [", "film.yaml"),
    ],
)
def test_an_edit_that_cannot_be_made_is_refused_by_name(
    tmp_path: Path, old: str, new: str, said: str
) -> None:
    assert old in WRONG
    with pytest.raises(CourseError, match=said):
        known("film", folder(tmp_path, WRONG.replace(old, new, 1)))


def test_lines_that_stand_twice_are_refused(tmp_path: Path) -> None:
    place = folder(tmp_path)
    (place / "film.py").write_text(
        SOLUTION.replace("        x = x / by\n", "        x = x / by\n" * 2)
    )
    with pytest.raises(CourseError, match="stands 2 times in _part; expected once"):
        known("film", place)
