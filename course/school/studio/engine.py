"""The reference in a copy without solutions: compiled loops have forms of their own of what the course's functions do.

They know no more than the fused loop does (``course.engine.loops.fused``): not every scene has a reference there.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from course.base.errors import CourseError
from course.engine.core.types import Floats32
from course.engine.functions.effects import Effects
from course.engine.functions.own import EngineForm
from course.engine.render.background_compile import tried
from course.engine.render.binding import bind
from course.engine.scene.scene import Scene, SceneSettings
from course.school.studio.passes import Progressive, may_compile

ENGINE = "engine"
"""Names these effects to a process that renders."""

NO_REFERENCE = (
    "This copy has no solutions, and the renderer's compiled loops don't know all that this scene asks for, so there is"
    " no reference. `course check` says what is right."
)

NO_RAYS = (
    "This copy has no solutions, so the reference's rays can't be told. Where a picture is wrong,"
    " `course check MODULE --html report.html` shows the right rays of one of its pixels."
)


class EngineEffects(Effects):
    """Stands for all functions; the compiled loops never call them."""

    def __init__(self) -> None:
        super().__init__("mine")
        self._rest, self._stands_in, self.trusted = None, False, True

    def written(self, module: str, name: str) -> bool:
        """Nothing is a student's."""
        return False

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """See ``Effects``."""
        return _FILM.get(f"{module}.{name}", EngineForm(f"{module}.{name}"))


def _weights(offsets: Floats32, sigma: float) -> Floats32:
    # A density along each axis; the factor before it divides out.
    along: Floats32 = np.exp(((offsets - np.float32(0.5)) / np.float32(sigma)) ** 2 / -2)
    weights: Floats32 = along.prod(axis=0)
    return weights


def _mean(radiance: Floats32, weights: Floats32) -> Floats32:
    mean: Floats32 = np.average(radiance, axis=-1, weights=np.stack((weights,) * len(radiance)))
    return mean.astype(np.float32)


_FILM: dict[str, Callable[..., Any]] = {
    "supersampling.gaussian_weights": _weights,
    "supersampling.resolve": _mean,
}
"""The film calls these for all samples of a pass at once, outside of the loops."""


def engines_picture(scene: Scene, settings: SceneSettings) -> Progressive:
    """A picture without a sample yet, by Sobol's points; CourseError if the loops don't know all that the scene has."""
    if settings.subdivision is None and may_compile():
        from course.engine.loops.fits import fits

        settings = replace(settings, sampler="sobol")
        if fits(bind(scene, settings)):
            picture = Progressive(scene, settings, compiled=True)
            tried(picture.tracer)
            return picture
    raise CourseError(NO_REFERENCE)
