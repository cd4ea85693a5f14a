"""Which functions are checked next, and which one is to be written next."""

from pathlib import Path
from typing import Any

import pytest

from course.engine.functions.modules import COURSE
from course.school.grading.progress import some_of
from course.school.studio import verdicts
from course.school.studio.verdicts import Verdicts
from tests.school.studio.conftest import RIGHT, WRONG, write

NEEDS = ["soft_shadows.point_on_sphere", "supersampling.resolve"]


class Checker:
    """Notes what it is asked for, and checks nothing."""

    def __init__(self, *_: Any) -> None:
        self.run, self.asked, self.ended = 0, [], 0

    def check(self, modules: list[str], _first: list[str], nice: bool) -> None:
        self.asked.append((list(modules), nice))

    def stop(self) -> None:
        self.ended += 1

    def prepare(self) -> None:
        pass


@pytest.fixture
def known(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    monkeypatch.setattr(verdicts, "Checker", Checker)
    made = Verdicts(tmp_path, None, lambda _: None, lambda: None)
    made.know(NEEDS)
    return made


def found(module: str, name: str, state: str) -> dict[str, Any]:
    return {
        "module": module,
        "name": name,
        "state": state,
        "points": 0.0,
        "of": 10.0,
        "title": "",
        "found": "",
        "again": "",
        "page": "",
        "file": f"{module}.py",
        "line": 1,
    }


def test_what_is_saved_comes_first_then_the_scene_s_then_the_rest(known: Any) -> None:
    checker = known._checker
    known.start(idle=False)
    assert checker.asked == []
    known.soon()
    known.start(idle=False)
    assert checker.asked == [(["supersampling", "soft_shadows"], True)]
    # A save ends these checks, and waits for nothing.
    known.check(["soft_shadows"])
    assert checker.ended == 1
    assert known.first
    known.start(idle=False)
    assert checker.asked[1:] == [(["soft_shadows"], False)]
    known.on_check({"run": 0, "module": "soft_shadows", "functions": [], "part": True})
    assert not known.first
    for end in ({"module": "soft_shadows", "functions": []}, {"done": True}):
        known.on_check({"run": 0, **end})
    known.soon()
    known.start(idle=False)
    assert checker.asked[2:] == [(["supersampling"], True)]
    known.on_check({"run": 0, "done": True})
    # The other modules wait until there is nothing to render.
    known.start(idle=False)
    assert len(checker.asked) == 3
    known.start(idle=True)
    assert len(checker.asked[3][0]) == len(COURSE) - 2


def test_a_file_that_the_scene_does_not_call_keeps_no_picture_waiting(known: Any) -> None:
    known.check(["glossy"])
    assert not known.first
    known.start(idle=False)
    assert known._checker.asked == [(["glossy"], False)]


def test_what_the_scene_calls_is_suggested_before_the_rest(known: Any) -> None:
    """In the scene of soft_shadows it had been supersampling.regular."""
    for module in ("supersampling", "soft_shadows"):
        functions = [found(module, name, "to do") for name in COURSE[module]]
        known.functions[module] = {"functions": functions}
    # Nothing of these is called, and it is wrong all the same.
    known.functions["glossy"] = {"functions": [found("glossy", COURSE["glossy"][0], "wrong")]}
    assert known.told()["next"] in NEEDS
    for one in known.functions["supersampling"]["functions"]:
        one["state"] = "right"
    assert known.told()["next"] == "soft_shadows.point_on_sphere"
    for one in known.functions["soft_shadows"]["functions"]:
        one["state"] = "right"
    assert known.told()["next"] == f"glossy.{COURSE['glossy'][0]}"


def test_numbers_are_said_to_be_found_or_expected(work: Path) -> None:
    """Of a wrong function it had been said "8785"."""
    write(work, WRONG)
    (one,) = some_of(work / "assignments", "soft_shadows", ["point_on_sphere"])
    assert one.state == "wrong"
    assert one.found.startswith("found ")
    assert ", expected " in one.found
    write(work, RIGHT)
    (one,) = some_of(work / "assignments", "soft_shadows", ["point_on_sphere"])
    assert (one.state, one.found) == ("right", "")
    # All functions of a module at once save no time.
    assert some_of(work / "assignments", "soft_shadows", COURSE["soft_shadows"]) == []
