"""The heart of rendering: film, schedule and executor are handed to it, and it knows none of their kinds."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import CourseError, error_over_time, load_scene, render
from course.engine.core.film import Film
from course.engine.core.schedule import Run, Schedule
from course.engine.core.schedule import render as render_film
from course.engine.core.tiles import Tile, Work
from course.engine.render.threads import Execution, ThreadedExecutor
from tests.conftest import MakeScene


class Steps(ThreadedExecutor):
    """Renders piece by piece in this thread, and tells after each; a second passes with every piece."""

    def __init__(self) -> None:
        super().__init__(servers=0)
        self.now = 0.0

    @property
    def threads(self) -> int:
        return 1

    @property
    def seconds_left(self) -> float:
        return self.deadline - self.now

    def serve(self, run: Execution) -> None:
        raise AssertionError

    def run(self, work: Iterable[Work], film: Any, tick: Any = None) -> bool:
        first = 0
        for count, item in enumerate(work):
            if self.seconds_left <= 0:
                return False
            mean = np.full((3, item.tile.size), np.float32(1 + item.order))
            film.add(item.tile, mean, 1.0, item.first + item.samples, item.summed)
            first += item.order == 0
            self.now += 1
            tick(count + 1, first)
        return True


def pieces(order: int) -> list[Work]:
    return [Work(Tile(x, x, 0, 1, 1), order, order, 1, True) for x in range(2)]


class Rounds(Schedule):
    """What somebody may add: rounds of any work."""

    def __init__(self, *rounds: tuple[Any, ...]) -> None:
        self.rounds = rounds

    def render(self, run: Run, executor: ThreadedExecutor) -> bool:
        return all(run(*each) for each in self.rounds)


def told(schedule: Schedule, executor: ThreadedExecutor, film: Film) -> tuple[bool, list[Any]]:
    progress: list[Any] = []
    complete = render_film(film, schedule, executor, lambda *now: progress.append(now))
    return complete, progress


def test_any_schedule_brings_its_work_into_the_film() -> None:
    film = Film(2, 1)
    complete, progress = told(Rounds((pieces(0), 0.0, 0.5), (pieces(1), 0.5, 1.0)), Steps(), film)
    assert complete
    assert film.linear[0].tolist() == [[1.5, 1.5]]
    assert film.samples.tolist() == [[2, 2]]
    assert progress == [(0.25, False), (0.5, True), (0.75, True), (1.0, True)]


def test_the_picture_is_covered_when_its_first_pass_is_done() -> None:
    _, progress = told(Rounds((pieces(0) + pieces(1),)), Steps(), Film(2, 1))
    assert progress == [(0.25, False), (0.5, True), (0.75, True), (1.0, True)]


def test_the_clock_tells_the_share_where_it_is_further_and_of_work_without_end() -> None:
    executor = Steps()
    executor.deadline = executor._time_limit = 4.0
    endless = (piece for order in range(100) for piece in pieces(order))
    film = Film(2, 1)
    complete, progress = told(Rounds((pieces(0), 0.0, 0.0), (endless,)), executor, film)
    assert not complete
    assert progress == [(0.25, False), (0.5, True), (0.75, True), (1.0, True)]


@pytest.mark.parametrize("error", [0, 0.0])
def test_an_error_of_zero_can_not_be_reached(make_scene: MakeScene, error: float) -> None:
    with pytest.raises(CourseError, match="expected a finite radiance > 0"):
        render(make_scene(), error=error, spp=64)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"spp": 1.5}, "spp: 1.5 is no whole number"),
        ({"seed": "7"}, "seed: '7' is no whole number"),
        ({"size": 30}, r"size=30: expected \(width, height\)"),
        ({"size": "30x20"}, r"size='30x20': expected \(width, height\)"),
        ({"size": (30.0, 20)}, "size: 30.0 is no whole number"),
    ],
)
def test_settings_of_another_kind_are_told(
    make_scene: MakeScene, given: dict[str, Any], told: str
) -> None:
    with pytest.raises(CourseError, match=told):
        render(make_scene(), **given)


def test_whole_numbers_may_be_numpys(make_scene: MakeScene) -> None:
    picture = render(make_scene(), spp=np.int64(1), size=(np.int32(4), 3))  # type: ignore[arg-type]
    assert picture.linear.shape == (3, 4, 3)


def test_what_is_no_scene_and_no_picture_is_told(make_scene: MakeScene) -> None:
    with pytest.raises(CourseError, match=r"render\(load_scene\('soft_shadows'\)\)"):
        render("soft_shadows")  # type: ignore[arg-type]
    with pytest.raises(CourseError, match="not NoneType"):
        error_over_time(None)  # type: ignore[arg-type]
    with pytest.raises(CourseError, match="not int"):
        render(make_scene(), spp=1, size=(4, 3)).compare(3)  # type: ignore[arg-type]


def test_a_scene_that_may_be_meant_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "assignments").mkdir()
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "soft_shadows.yaml").touch()
    monkeypatch.chdir(tmp_path / "assignments")
    with pytest.raises(CourseError, match="did you mean before/soft_shadows"):
        load_scene("before/soft_shadow", "solutions")
    with pytest.raises(CourseError, match="no scene of that name; scenes/README"):
        load_scene("xyz", "solutions")
    with pytest.raises(CourseError, match=r"did you mean .*scenes/soft_shadows\.yaml\?"):
        load_scene("soft_shadow.yaml", "solutions")
