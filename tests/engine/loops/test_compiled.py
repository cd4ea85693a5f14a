"""Compiled loops give the same picture."""

import sys

import pytest

from course import render
from course.base.errors import CourseError
from course.engine.render import which_loops
from tests.engine.conftest import EveryStage
from tests.forms import needs_numba


@needs_numba
@pytest.mark.parametrize("threads", [1, 3])
def test_the_picture_is_the_same_bit_for_bit(every_stage: EveryStage, threads: int) -> None:
    scene = every_stage(film={"width": 60, "height": 44})
    single = render(scene, spp=24, threads=threads, compiled=False)
    packet = render(scene, spp=24, threads=threads, compiled=True)
    assert single.linear.tobytes() == packet.linear.tobytes()


def test_without_numba_everything_works_and_asking_for_it_is_an_error(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(which_loops, "available", lambda: False)
    scene = every_stage(film={"width": 8, "height": 6})
    render(scene, spp=1)
    with pytest.raises(CourseError, match=r"pip install \.\[fast\]"):
        render(scene, spp=1, compiled=True)


@needs_numba
def test_small_renders_do_not_wait_for_numba(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = every_stage(film={"width": 8, "height": 6})
    monkeypatch.delitem(sys.modules, "numba", raising=False)
    monkeypatch.delenv(which_loops.NO_COMPILER)
    settings = scene.settings
    assert not which_loops.wants_compiled(settings, None)
    assert which_loops.wants_compiled(settings, True)
    monkeypatch.setattr(which_loops, "WORTH_COMPILED", 1)
    assert which_loops.wants_compiled(settings, None)
    monkeypatch.setenv(which_loops.NO_COMPILER, "1")
    assert not which_loops.wants_compiled(settings, None)
