"""Which loops follow a render's rays: NumPy's, Numba's, or NumPy's until Numba's are ready; all make the same bits."""

import os
import sys
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from typing import Protocol

from course.base.errors import CourseError
from course.engine.casters.choice import VARIABLE
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import Bound
from course.engine.loops.embree_device import available
from course.engine.loops.engine import compiled, has_loops
from course.engine.render.binding import bind
from course.engine.render.threads import Pool
from course.engine.scene.scene import Scene, SceneSettings

WORTH_COMPILED = 5_000_000
"""Camera rays from which on compiled loops save more than Numba takes to get ready."""

WORTH_READING = 50_000
"""Pixels from which on any error to aim at takes so many samples that compiled loops are worth their reading."""

NO_COMPILER = "COURSE_NO_COMPILER"
"""Environment variable: if it is set, nothing is compiled but by ``compiled=True``."""


class Closing(Protocol):
    """What goes on until it is closed."""

    def close(self) -> None:
        """End it."""


@dataclass(frozen=True)
class Loops:
    """The loops of a render.

    Attributes
    ----------
    tracer : with which it begins
    film : whether an adaptive film's arithmetic is compiled
    take_over : given the pool of threads, begins to make compiled loops ready that take over, until what it returns is
        closed; None where none will
    """

    tracer: Tracer
    film: bool
    take_over: Callable[[Pool], Closing] | None = None


def wants_compiled(settings: SceneSettings, wanted: bool | None) -> bool:
    """Whether Numba's loops are used where a scene has them; ``wanted`` None means where that pays.

    Raises CourseError where they are wanted and can't be had.
    """
    if wanted and not available():
        raise CourseError(
            "compiled loops need Numba (pip install .[fast]), a NumPy whose own loops are found, and a caster that they"
            f" can call: {VARIABLE} must not be numpy"
        )
    if wanted is not None:
        return wanted
    if os.environ.get(NO_COMPILER):
        return False
    rays = settings.width * settings.height * settings.samples
    return available() and ("numba" in sys.modules or rays >= WORTH_COMPILED)


def may_change_over(settings: SceneSettings) -> bool:
    """True if NumPy may begin and compiled loops go on.

    Corners of cells are no pieces of work: their tracer is compiled before they begin.
    """
    return settings.subdivision is None


def read_first(settings: SceneSettings, time_limit: float | None) -> bool:
    """True if the render will surely take longer than loops take to be read, so that NumPy needn't begin."""
    if "numba" in sys.modules:
        return True
    if time_limit is not None:
        # So that there is something to be seen soon.
        return False
    pixels = settings.width * settings.height
    return settings.error is None or pixels >= WORTH_READING


def choose_loops(
    scene: Scene,
    settings: SceneSettings,
    bound: Bound,
    wanted: bool | None,
    time_limit: float | None,
    closed: ExitStack,
) -> Loops:
    """The loops of a render on this machine.

    Parameters
    ----------
    bound : where functions that are called are noted down
    wanted : see ``wants_compiled``
    closed : ends what listens to the compiler
    """
    tracer = bind(scene, settings, bound)
    if not (wants_compiled(settings, wanted) and has_loops(tracer)):
        return Loops(tracer, film=False)
    from course.engine.render import background_compile as loops

    make = partial(compiled, tracer, settings.shafts)
    if wanted or not may_change_over(settings):
        if wanted is None:
            closed.enter_context(loops.compiling_told())
        return Loops(make(), film=True)
    first = read_first(settings, time_limit)
    if first and (read := loops.read(make, scene.effects)) is not None:
        if not scene.effects.all_own:
            # Whatever is compiled when it is first called.
            closed.enter_context(loops.compiling_told())
        film = settings.error is None or loops.film_is_read()
        if not film:
            loops.compile_loops(scene, settings)
        return Loops(read, film)

    def take_over(pool: Pool) -> loops.BackgroundCompiler:
        return loops.BackgroundCompiler(pool, make, scene, settings, tried_to_read=first)

    return Loops(tracer, False, take_over)


def loops_of_cluster(
    scene: Scene, settings: SceneSettings, bound: Bound, wanted: bool | None
) -> Loops:
    """The same where workers of a cluster follow the rays: with compiled loops where film is, if they have them."""
    return Loops(bind(scene, settings, bound), film=wants_compiled(settings, wanted))
