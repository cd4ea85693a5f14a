"""A background process compiles the loops that are not on disk yet, while NumPy renders.

Then pieces of work change over to the loops, for both make the same bits. In this process, compiling would hold the
interpreter's lock, which rendering threads need. The other one is ``python -m
course.engine.render.background_compile``.
"""

import logging
import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from threading import Event, Thread
from typing import Any

from course.base.errors import CourseError
from course.base.processes import environment_apart
from course.engine.core.counters import Counters
from course.engine.core.tiles import Tile, pass_size
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import PROJECT, Effects, NothingWritten
from course.engine.functions.modules import COURSE
from course.engine.render.threads import Pool
from course.engine.scene.scene import Scene, SceneSettings, load_scene

LAST = 10
"""Added to the niceness of the process that compiles: the picture comes first."""

POLL = 0.05
"""Seconds between two looks at the process that compiles."""

LITTLE = 24, 16
"""Columns and rows of a picture that is rendered so that loops are compiled."""

MODULE = "course.engine.render.background_compile"
"""The program of the process that compiles. A user has one of them at a time."""

COMPILING = "compiling loops that this machine has not compiled yet, which takes some 15 s, once"

_COMPILING: dict[bytes, subprocess.Popen[bytes]] = {}
"""By task: the process of this program that compiles, if there is one. Python warns of one whose object goes first."""


class NotCompiledError(Exception):
    """A loop is not on disk."""


@contextmanager
def compiling_nothing() -> Iterator[None]:
    """Let loops be read from disk; NotCompiledError where one would be compiled.

    Whatever Numba reads, it first imports all that it can compile, of Python's and of NumPy's: that takes as long as to
    read the loops, and is left out. Where something is compiled afterwards, Numba imports it then.
    """
    from numba.core import event
    from numba.core.caching import Cache
    from numba.core.registry import cpu_target
    from numba.core.runtime import rtsys

    load = Cache.load_overload

    def read(cache: Any, signature: Any, context: Any) -> Any:
        # Numba's lock keeps others from compiling meanwhile. What is read may import, and so read, something else.
        context.refresh = lambda: None
        try:
            return load(cache, signature, context)
        finally:
            vars(context).pop("refresh", None)

    class Refusal(event.Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            raise NotCompiledError

        def on_end(self, event: Any) -> None:
            pass

    # What loops allocate arrays with; it would have come with the imports.
    rtsys.initialize(cpu_target.target_context)
    Cache.load_overload = read
    try:
        with event.install_listener("numba:compile", Refusal()):
            yield
    finally:
        Cache.load_overload = load


@contextmanager
def compiling_told() -> Iterator[None]:
    """Log one line where the first loop is compiled that is not on disk: a picture then begins many seconds later."""
    from numba.core import event

    class Telling(event.Listener):  # type: ignore[misc]
        told = False

        def on_start(self, event: Any) -> None:
            if not self.told:
                self.told = True
                logging.getLogger("course").warning(COMPILING)

        def on_end(self, event: Any) -> None:
            pass

    with event.install_listener("numba:compile", Telling()):
        yield


def tried(tracer: Tracer) -> Tracer:
    """The tracer, after it has rendered the pixel in the middle: some loops are compiled when they are first called."""
    settings = tracer.settings
    middle = Tile(0, settings.width // 2, settings.height // 2, 1, 1)
    tracer.render_tile(middle, 0, pass_size(settings, tracer.sampler), Counters())
    return tracer


def read(compiled: Callable[[], Tracer], effects: Effects) -> Tracer | None:
    """The compiled tracer that this makes, if all its loops are on disk.

    ``effects``: where its functions are from. A student's aren't called to see that: what is missing then is compiled
    when it is first called.
    """
    try:
        with compiling_nothing():
            tracer = compiled()
            return tried(tracer) if effects.all_own else tracer
    except (NotCompiledError, ImportError):
        # An older Numba refuses a newer NumPy; that is no reason to have no picture.
        return None


def film_is_read() -> bool:
    """Whether the loops of an adaptive film are on disk; they are read then."""
    try:
        with compiling_nothing():
            _try_film()
    except NotCompiledError:
        return False
    return True


def _try_film() -> None:
    from course.engine.render.adaptive.compiled_film import CompiledFilm

    CompiledFilm.tried()


class BackgroundCompiler:
    """Gives the threads of a pool a compiled tracer as soon as its loops are ready.

    Parameters
    ----------
    pool : renders with a tracer of NumPy's
    compiled : makes the compiled tracer
    scene, settings : for the process that compiles
    tried_to_read : whether it is known already that loops are not on disk
    """

    def __init__(
        self,
        pool: Pool,
        compiled: Callable[[], Tracer],
        scene: Scene,
        settings: SceneSettings,
        tried_to_read: bool = False,
    ) -> None:
        self._pool, self._compiled = pool, compiled
        self._task, self._effects = _task(scene, settings), scene.effects
        self._closed = Event()
        # Once Numba is there, loops are read from disk before the first piece of work is done.
        at_once = "numba" in sys.modules and not tried_to_read
        ready, tried = at_once and self._read(), at_once or tried_to_read
        self._thread = None if ready else Thread(target=self._run, args=(tried,), daemon=True)
        if self._thread is not None:
            self._thread.start()

    def _run(self, tried_to_read: bool) -> None:
        # A function that fails fails in the threads that render, too, and they tell of it.
        with suppress(CourseError, NotImplementedError):
            self._get_ready(tried_to_read)

    def _get_ready(self, tried_to_read: bool) -> None:
        if not tried_to_read:
            import numba  # noqa: F401

            if self._closed.is_set() or self._read():
                return
        if self._compile() and not self._closed.is_set():
            # What that process has not compiled, for the scene may differ from its file, is compiled here.
            tracer = self._compiled()
            self._pool.tracer = tried(tracer) if self._effects.all_own else tracer

    def _read(self) -> bool:
        """Exchange the tracer if all its loops are on disk."""
        if (tracer := read(self._compiled, self._effects)) is not None:
            self._pool.tracer = tracer
        return tracer is not None

    def _compile(self) -> bool:
        """Wait for a process that compiles, at most until the picture is there; true if it has compiled all."""
        process = _started(self._task)
        if process is None:
            return False
        while process.poll() is None:
            if self._closed.wait(POLL):
                return False
        return process.returncode == 0

    def close(self) -> None:
        """Exchange nothing any more. A process that compiles goes on to its end, so that the next render is fast."""
        self._closed.set()
        if self._thread is not None:
            # Not left behind where the program may end.
            self._thread.join()


def _task(scene: Scene, settings: SceneSettings) -> tuple[Any, ...]:
    effects = scene.effects
    if effects.trusted:
        return scene.path.resolve(), effects.folder.resolve(), settings, ()
    if effects.all_own:
        return scene.path.resolve(), None, settings, ()
    return _task_of_a_student(scene, settings)


def _task_of_a_student(scene: Scene, settings: SceneSettings) -> tuple[Any, ...]:
    """On a small picture, with functions that aren't known in the place of a student's."""
    width, height = LITTLE
    little = replace(settings, width=width, height=height, samples=4, subdivision=None)
    effects = scene.effects
    unknown = tuple(
        f"{module}.{name}"
        for module, names in COURSE.items()
        for name in names
        if not effects.mixed or effects.written(module, name)
    )
    return scene.path.resolve(), None, little, unknown


def compile_loops(scene: Scene, settings: SceneSettings) -> None:
    """Have a process compile what a render has not found on disk; nobody waits for it."""
    _started(_task(scene, settings))


def compile_for_a_student(scene: Scene, settings: SceneSettings) -> None:
    """Have a process compile the loops that a scene has with a student's functions; nobody waits for it."""
    _started(_task_of_a_student(scene, settings))


def _started(task: tuple[Any, ...]) -> subprocess.Popen[bytes] | None:
    """A process that compiles; None while one that this program started compiles something else."""
    asked = pickle.dumps(task)
    for known in [known for known, process in _COMPILING.items() if process.poll() is not None]:
        del _COMPILING[known]
    if _COMPILING:
        return _COMPILING.get(asked)
    process = subprocess.Popen(
        [sys.executable, "-m", MODULE],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=environment_apart(),
        # Ctrl-C ends the picture; what is compiled is for the next one, too. In a session of its own the process
        # would be no guest: Linux shares processors between sessions first, and only then by niceness.
        process_group=0,
    )
    _COMPILING[asked] = process
    assert process.stdin is not None
    with process.stdin as pipe:
        pipe.write(asked)
    return process


def _another_compiles() -> bool:
    """True if this user has an older process that compiles: many renders at once would compile the same loops."""
    import psutil

    me = psutil.Process()
    for other in psutil.process_iter(["cmdline", "create_time", "pid", "username"]):
        known = other.info
        ours = MODULE in (known["cmdline"] or ()) and known["username"] == me.username()
        if ours and (known["create_time"], known["pid"]) < (me.create_time(), me.pid):
            return True
    return False


class Own(Effects):
    """The course's own functions, or stand-ins for them.

    ``unknown``: those of which the compiler knows no more than of a student's, so that no loop has a form of them;
    "module.function"
    """

    def __init__(self, unknown: Iterable[str]) -> None:
        solved = (PROJECT / "solutions").is_dir()
        self._source = Effects("solutions") if solved else NothingWritten()
        vars(self).update(vars(self._source))
        self._unknown = frozenset(unknown)

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """See ``Effects``."""
        function = self._source.function(module, name)
        return partial(function) if f"{module}.{name}" in self._unknown else function


def main() -> None:
    """Compile the loops of the scene and the settings that come in, and keep them on disk.

    It ends with 1 if another process compiles already.
    """
    path, folder, settings, unknown = pickle.load(sys.stdin.buffer)
    if _another_compiles():
        sys.exit(1)
    if hasattr(os, "nice"):
        os.nice(LAST)
    from course.engine.render.binding import bind

    scene = load_scene(path, folder or Own(unknown))
    tracer = bind(scene, settings, compiled=True)
    if unknown:
        whole = Tile(0, 0, 0, settings.width, settings.height)
        tracer.render_tile(whole, 0, settings.samples, Counters())
    else:
        tried(tracer)
    if settings.error is not None:
        _try_film()


if __name__ == "__main__":
    main()
