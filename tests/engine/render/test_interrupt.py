"""Ctrl-C: the picture so far comes back."""

import gc
import signal
import warnings
import weakref
from contextlib import suppress
from pathlib import Path
from threading import Event, Thread
from time import monotonic
from typing import Any

import numpy as np
import pytest

from course import EffectError, render
from course.base.errors import CourseError, FunctionError
from course.engine.functions.guard import Guard
from course.engine.render.endless import LongCalls
from tests.engine.conftest import EveryStage


def test_every_pixel_of_an_interrupted_picture_is_right_for_its_samples(
    every_stage: EveryStage,
) -> None:
    scene = every_stage(film={"width": 96, "height": 64})

    def progress(_done: float, covered: bool) -> None:
        if covered:
            signal.raise_signal(signal.SIGINT)

    picture = render(scene, spp=4096, progress=progress, threads=2)
    assert picture.interrupted
    samples = np.unique(picture.film.samples)
    assert 16 <= samples[0] <= picture.receipt.samples <= samples[-1] < 4096
    assert picture.receipt.rays["camera"] >= picture.receipt.samples * 96 * 64
    assert 0 < picture.linear.max(axis=2).min() < picture.linear.max() < 100
    for count in samples[:3]:
        these = picture.film.samples == count
        whole = render(scene, spp=int(count))
        assert np.array_equal(picture.linear[these], whole.linear[these])
    with pytest.raises(CourseError, match="complete"):
        render(scene, spp=8192, start=picture)


@pytest.mark.parametrize("which", [0, 1, 2])
@pytest.mark.parametrize("begun", [False, True])
def test_ctrl_c_while_threads_are_started(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch, which: int, begun: bool
) -> None:
    """It comes before one of them begins, or after, in the wait for its first step."""
    scene, start, started = every_stage(), Thread.start, list[Thread]()

    def interrupted(thread: Thread) -> None:
        if not thread.name.startswith("tiles"):
            return start(thread)
        if len(started) < which or begun:
            start(thread)
        started.append(thread)
        if len(started) == which + 1:
            raise KeyboardInterrupt
        return None

    monkeypatch.setattr(Thread, "start", interrupted)
    assert render(scene, spp=4096, threads=3).interrupted
    assert len(started) == which + 1
    assert not any(map(Thread.is_alive, started))


def test_a_function_that_does_not_come_back_is_told_while_one_waits() -> None:
    begun, over = Event(), Event()

    def resolve(*_: object) -> None:
        begun.set()
        over.wait()

    guard = Guard("supersampling.resolve", resolve, Path("supersampling.py"))

    def work() -> None:
        with suppress(FunctionError):
            guard(np.zeros((3, 2, 1), np.float32), np.ones(2, np.float32))

    thread = Thread(target=work, daemon=True)
    thread.start()
    begun.wait()
    calls, now = LongCalls(), monotonic()
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for second in (2, 4, 6, 8, 9, 30):
            calls.look([thread], now + second)
            # The first look is at 2.
            assert len(told) == (second >= 8)
    assert "still in supersampling.resolve (supersampling.py:" in str(told[0].message)
    over.set()
    thread.join()


def test_a_look_at_threads_keeps_nothing_of_theirs() -> None:
    """Not until garbage is collected, either: renders of the command line kept 50 MB a second so."""
    held, done, kept = Event(), Event(), list[weakref.ref[Any]]()

    def work() -> None:
        rays = np.zeros(1000)
        kept.append(weakref.ref(rays))
        held.set()
        done.wait()

    thread = Thread(target=work)
    gc.disable()
    try:
        thread.start()
        held.wait()
        LongCalls().look([thread], monotonic())
        done.set()
        thread.join()
        assert kept[0]() is None
    finally:
        gc.enable()


def test_an_error_in_a_thread_reaches_the_caller(every_stage: EveryStage, tmp_path: Path) -> None:
    (tmp_path / "supersampling.py").write_text(
        "def resolve(radiance, weights):\n    raise ZeroDivisionError('in a tile')\n"
    )
    from course import load_scene

    plain = every_stage(lights=[])
    scene = load_scene(plain.path, effects=tmp_path)
    with pytest.raises(
        EffectError, match=r"raised ZeroDivisionError: in a tile in line 2 of supersampling"
    ):
        render(scene, spp=64, threads=2)
