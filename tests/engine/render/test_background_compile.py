"""Loops that get ready while NumPy renders: this process compiles nothing meanwhile, and the bits stay the same."""

import pickle
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest

from course import Scene, load_scene, render
from course.engine.casters.choice import chosen
from course.engine.core.accelerator import StaticAccelerator
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE
from course.engine.loops import embree_device
from course.engine.render.binding import bind
from course.engine.render.threads import Pool

if not embree_device.available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from course.engine.render import background_compile, which_loops
from course.engine.render import render as render_scene
from course.engine.render.adaptive import film_kernels
from course.engine.render.adaptive.compiled_film import CompiledFilm

EveryStage = Callable[..., Scene]

BALL = [{"shape": "sphere", "material": "white"}]


def test_a_picture_by_both_tracers_in_turn_has_the_same_bits(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = every_stage(film={"width": 60, "height": 44})
    expected = render(scene, spp=64, threads=2, compiled=False)
    taken = []

    class Alternating(Pool):
        @property
        def tracer(self) -> Tracer:  # type: ignore[override]
            taken.append(len(taken) % 2)
            return self._both[taken[-1]]

        @tracer.setter
        def tracer(self, tracer: Tracer) -> None:
            self._both = tracer, bind(scene, tracer.settings, compiled=True)

    monkeypatch.setattr(render_scene, "Pool", Alternating)
    mixed = render(scene, spp=64, threads=2, compiled=False)
    assert set(taken) == {0, 1}
    assert mixed.linear.tobytes() == expected.linear.tobytes()
    assert mixed.receipt.rays == expected.receipt.rays


def test_loops_are_read_but_not_compiled() -> None:
    import numba

    with background_compile.compiling_nothing(), pytest.raises(background_compile.NotCompiledError):
        numba.njit("int64(int64)")(lambda x: x + 1)
    assert numba.njit("int64(int64)")(lambda x: x + 1)(1) == 2


def test_what_is_compiled_is_told_in_one_line(caplog: pytest.LogCaptureFixture) -> None:
    import numba

    with background_compile.compiling_told():
        assert caplog.messages == []
        for doubled in (lambda x: x + x, lambda x: 2 * x):
            assert numba.njit("int64(int64)")(doubled)(4) == 8
    numba.njit("int64(int64)")(lambda x: x + 3)
    assert caplog.messages == [background_compile.COMPILING]


@pytest.mark.parametrize(("folder", "asked"), [("solutions", None), ("own", None), ("own", True)])
def test_only_a_render_that_waits_for_loops_tells_of_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, folder: str, asked: bool | None
) -> None:
    """The course's own functions wait for none, and who asks for loops knows of them.

    A student's wait for what is compiled when it is first called.
    """
    if folder == "own":
        folder = str(tmp_path)
        shutil.copy(PROJECT / "solutions" / "supersampling.py", tmp_path)
        shutil.copy(PROJECT / "solutions" / "thin_lens.py", tmp_path)
    monkeypatch.delenv(which_loops.NO_COMPILER, raising=False)
    told: list[int] = []

    @contextmanager
    def telling() -> Iterator[None]:
        told.append(1)
        yield

    monkeypatch.setattr(background_compile, "compiling_told", telling)
    monkeypatch.setattr(background_compile, "read", lambda make, _effects: make())
    scene = load_scene(PROJECT / "scenes" / "thin_lens.yaml", effects=folder)
    render(scene, spp=1, size=(12, 8), compiled=asked)
    assert bool(told) == (folder != "solutions" and asked is None)


@pytest.mark.parametrize("written", [False, True])
def test_where_nothing_is_written_loops_are_those_of_the_course(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, written: bool
) -> None:
    """A student's first picture waited for a minute of compiling, for no function was taken to be known."""
    if written:
        shutil.copy(PROJECT / "solutions" / "soft_shadows.py", tmp_path)
    effects = Effects(tmp_path, filled=True)
    scene = load_scene(PROJECT / "scenes" / "soft_shadows.yaml", effects=effects)
    called: list[Tracer] = []
    monkeypatch.setattr(background_compile, "tried", lambda tracer: called.append(tracer) or tracer)
    tracer = background_compile.read(lambda: bind(scene, scene.settings), effects)
    assert called == ([] if written else [tracer])
    _, folder, settings, unknown = background_compile._task(scene, scene.settings)
    assert folder is None
    assert unknown == tuple(
        f"soft_shadows.{name}" for name in COURSE["soft_shadows"][: 5 * written]
    )
    assert (settings == scene.settings) == (not written)


@pytest.mark.parametrize("status", [None, 0, 1])
def test_a_render_waits_for_no_compiler(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch, status: int | None
) -> None:
    """Where loops are not on disk, a process compiles them; the tracer is exchanged when it has ended."""
    scene = every_stage(film={"width": 8, "height": 6})
    started: list[Any] = []

    class Process:
        def __init__(self, *arguments: Any, **_: Any) -> None:
            started.append(arguments)
            self.stdin = BytesIO()

        returncode = status

        def poll(self) -> int | None:
            return status

    compiled = bind(scene, scene.settings, compiled=True)
    answers = iter([background_compile.NotCompiledError(), compiled])

    def make() -> Tracer:
        if isinstance(answer := next(answers), Exception):
            raise answer
        return answer

    monkeypatch.setattr(background_compile.subprocess, "Popen", Process)
    monkeypatch.setattr(background_compile, "_COMPILING", {})
    numpy = bind(scene, scene.settings)
    pool = Pool(numpy, 1)
    ready = background_compile.BackgroundCompiler(pool, make, scene, scene.settings)
    if status is None:
        ready.close()
    else:
        assert ready._thread is not None
        ready._thread.join()
    assert len(started) == 1
    # While it runs, renders of other pictures start none; one that has ended is forgotten.
    other = background_compile._task(scene, replace(scene.settings, seed=7))
    assert (background_compile._started(other) is None) == (status is None)
    assert len(started) == (1 if status is None else 2)
    # A process that ended with 1 left it to another one, and NumPy renders to the end.
    assert pool.tracer is (compiled if status == 0 else numpy)
    assert "numba" in sys.modules


def test_students_functions_are_not_called_to_see_whether_loops_are_ready(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """NumPy begins; a process compiles with functions that are not theirs, and then the tracer is exchanged."""
    for name in ("supersampling", "soft_shadows"):
        shutil.copy(PROJECT / "solutions" / f"{name}.py", tmp_path)
    scene = load_scene(PROJECT / "scenes" / "soft_shadows.yaml", effects=tmp_path)
    sent: list[Any] = []

    class Pipe(BytesIO):
        def close(self) -> None:
            if not self.closed:
                sent.append(pickle.loads(self.getvalue()))
            super().close()

    class Process:
        returncode = 0

        def __init__(self, *_: Any, **__: Any) -> None:
            self.stdin = Pipe()

        def poll(self) -> int:
            return 0

    monkeypatch.setattr(background_compile.subprocess, "Popen", Process)
    monkeypatch.setattr(background_compile, "_COMPILING", {})
    monkeypatch.setattr(background_compile, "tried", None)
    compiled = bind(scene, scene.settings, compiled=True)
    make = iter([None, lambda: compiled])
    pool = Pool(bind(scene, scene.settings), 1)

    def made() -> Tracer:
        if (answer := next(make)) is None:
            raise background_compile.NotCompiledError
        return answer()

    ready = background_compile.BackgroundCompiler(pool, made, scene, scene.settings)
    assert ready._thread is not None
    ready._thread.join()
    assert pool.tracer is compiled
    ((path, folder, settings, unknown),) = sent
    assert (path, folder) == (scene.path.resolve(), None)
    assert "soft_shadows.point_on_sphere" in unknown
    assert (settings.width, settings.height) == background_compile.LITTLE


@pytest.mark.parametrize("error", [None, 0.5])
def test_where_all_loops_are_on_disk_nothing_else_is_made_ready(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch, error: float | None
) -> None:
    """No hierarchy for single rays, no pass by NumPy and no process that compiles; the same bits."""
    scene = every_stage(film={"width": 60, "height": 44}, objects=BALL)
    expected = render(scene, spp=16, error=error, compiled=True)
    monkeypatch.delenv(which_loops.NO_COMPILER, raising=False)
    for name in ("_started", "BackgroundCompiler"):
        monkeypatch.setattr(background_compile, name, None)
    scene = every_stage(film={"width": 60, "height": 44}, objects=BALL)
    if chosen() == "embree":
        monkeypatch.setattr(StaticAccelerator, "caster", property(lambda _: 1 / 0))
    picture = render(scene, spp=16, error=error)
    assert picture.linear.tobytes() == expected.linear.tobytes()
    assert isinstance(picture.film, CompiledFilm) == (error is not None)


def test_a_film_that_was_tried_has_all_its_loops(every_stage: EveryStage) -> None:
    dispatchers = [each for each in vars(film_kernels).values() if hasattr(each, "overloads")]
    CompiledFilm.tried()
    before = [len(each.overloads) for each in dispatchers]
    render(every_stage(film={"width": 60, "height": 44}), error=0.02, compiled=True, spp=64)
    assert sum(before) >= 4
    assert [len(each.overloads) for each in dispatchers] == before


def test_one_process_compiles_at_a_time(tmp_path: Path) -> None:
    """A second one that begins while the first runs ends with 1 before it reads the scene."""
    # Named apart from what compiles for other renders of this user meanwhile.
    name = tmp_path.name
    line = [sys.executable, "-c", "import time; time.sleep(60)", name]
    with subprocess.Popen(line) as first:
        try:
            task = pickle.dumps((tmp_path / "no.yaml", tmp_path, None, False))
            program = f"import {background_compile.MODULE} as it; it.MODULE = {name!r}; it.main()"
            second = [sys.executable, "-c", program]
            done = subprocess.run(second, input=task, capture_output=True, check=False, timeout=60)
        finally:
            first.kill()
    assert (done.returncode, done.stderr) == (1, b"")
    done = subprocess.run(second, input=task, capture_output=True, check=False, timeout=60)
    assert b"no.yaml: no such file" in done.stderr
