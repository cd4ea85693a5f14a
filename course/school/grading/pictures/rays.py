"""The rays behind a wrong picture, the student's beside the right ones, at the pixel that is farthest off.

The right ones are recorded with the reference solution for some pixels of the picture, and kept as a check's arrays
are, so that a copy without solutions has them.
"""

import json
import zlib

import numpy as np

from course.engine.recording.pair import pair_data
from course.engine.recording.recording import record_each
from course.engine.recording.story import Story
from course.engine.recording.view import rays_data
from course.school.grading.checks.check import Array, Caller, Check, Trial
from course.school.grading.pictures.rendered import MakeScene, loaded
from course.school.grading.pictures.scenes import SIZE
from course.school.grading.pictures.stage import Stage

PIXELS = [(x, y) for y in range(4, SIZE[1], 9) for x in range(4, SIZE[0], 8)]
"""Columns and rows of the pixels that are kept: six across, four down."""

SAMPLES = 64
"""Of each of these pixels, at most."""

PICTURE = "picture"
"""The check whose scene it is."""


def rays_check(path: str, make: MakeScene) -> Check:
    """What shows the rays of the kept pixel that is farthest off, if one of them is off at all; it judges nothing.

    Parameters
    ----------
    path : "module.function"
    make : describes the scene of the function's picture
    """
    module, function = path.split(".")

    def prepare(caller: Caller, rng: np.random.Generator) -> dict[str, Array]:
        stage = Stage(module, caller, function, recording={})
        recordings = record_each(loaded(make(rng), stage.function, rng), PIXELS)
        return {"rays": _packed([rays_data(Story(each), SAMPLES) for each in recordings])}

    def run(trial: Trial) -> None:
        stage = Stage(module, trial.caller, function, tape=trial.references)
        scene = loaded(make(trial.rng), stage.function, trial.rng)
        recordings = record_each(scene, PIXELS)
        right = json.loads(zlib.decompress(trial.references["rays"].tobytes()))
        off = [_off(each.linear, own["color"]) for each, own in zip(recordings, right, strict=True)]
        worst = int(np.argmax(off))
        if off[worst] > FAINT:
            data = pair_data(Story(recordings[worst]), right[worst], path, SAMPLES)
            x, y = PIXELS[worst]
            trial.show("rays", f"The rays of pixel ({x}, {y})", data=_packed(data))

    title = "The rays behind the picture"
    return Check(function, "rays", title, run, "picture", 0, prepare=prepare, numbers=PICTURE)


FAINT = 1e-3
"""Difference in radiance that is rounding; the pictures' white is 1."""


def _off(yours: Array, right: object) -> float:
    with np.errstate(all="ignore"):
        difference = np.abs(yours.ravel() - np.array(right, np.float64)).sum()
    return float(np.nan_to_num(difference, nan=np.inf))


def _packed(data: object) -> Array:
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return np.frombuffer(zlib.compress(text.encode(), 9), np.uint8)
