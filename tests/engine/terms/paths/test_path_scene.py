"""The scene of path tracing and its twin: light that only one of them shows."""

import numpy as np

from course import load_scene, render
from course.engine.functions.effects import PROJECT

SCENES = PROJECT / "scenes"


def test_light_reaches_the_ceiling_and_gathers_below_the_glass() -> None:
    shown = [
        render(load_scene(SCENES / folder / "path_tracing.yaml"), size=(50, 50), spp=64).linear
        for folder in ("", "before")
    ]
    # Left of the lamp; and where the ball's shadow was, beneath the ball.
    ceiling, caustic = [
        [float(np.mean(picture[rows, columns])) for picture in shown]
        for rows, columns in ((slice(1, 3), slice(10, 16)), (slice(45, 47), slice(33, 38)))
    ]
    assert ceiling[1] == 0
    assert ceiling[0] > 0.05
    assert caustic[0] > 2 * caustic[1]
