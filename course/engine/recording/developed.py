"""What the functions of `film` make of a recorded pixel's colour on its way into a PNG."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.engine.core.types import Floats64
from course.engine.functions.effects import Bound
from course.engine.recording.recording import Recording
from course.engine.render.binding import developed_by
from course.engine.render.developing import Development


@dataclass(frozen=True)
class Step:
    """One function's part.

    Attributes
    ----------
    function : "film.name"
    before, after : (3,) means over the recorded pixels
    """

    function: str
    before: Floats64
    after: Floats64


def developed(recording: Recording) -> list[Step]:
    """The steps in their order, none where the scene asks for no function of `film`.

    Tone mapping looks at the whole picture: here it has the recorded pixels alone.
    Raises FunctionError: a function returns what it must not.
    """
    scene, settings = recording.scene, recording.settings
    asked = developed_by(scene)
    if not asked:
        return []
    bound = Bound(scene.effects, scene.compiled.needs)
    steps: list[Step] = []

    def noted(name: str) -> Callable[..., Any]:
        function = bound.function("film", name, ("film", asked[name]))

        def call(colors: Any, *rest: Any) -> Any:
            made = function(colors, *rest)
            before, after = (np.asarray(each, np.float64).mean(axis=1) for each in (colors, made))
            steps.append(Step(f"film.{name}", before, after))
            return made

        return call

    functions = {name: noted(name) for name in asked}
    Development(scene, bound, settings.seed, functions)(recording.linear)
    return steps
