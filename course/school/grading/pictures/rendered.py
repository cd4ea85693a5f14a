"""Checks that render: one function of the student's inside the pipeline, against the same with the reference's."""

import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from PIL import Image

from course.base.errors import EffectError
from course.engine.functions.contracts import contract
from course.engine.functions.effects import Effects
from course.engine.recording.stages import RecordedEffects
from course.engine.render.render import render
from course.engine.scene.scene import Scene, load_scene
from course.school.grading.checks.check import Array, Caller, Check, Trial
from course.school.grading.errors import StudentError
from course.school.grading.pictures import scenes
from course.school.grading.pictures.judging import (
    BIAS_FALSE_FAIL,
    block_means,
    check_bias,
    check_ssim,
)
from course.school.grading.pictures.stage import Stage

BIAS_SAMPLES = 16
BIAS_REFERENCES = 32
BIAS_PICTURES = 4

MakeScene = Callable[[np.random.Generator], scenes.Scene]

Find = Callable[[str, str], Callable[..., Any]]
"""(module, name) -> the function that a picture is made with."""


class _Found(Effects):
    """Effects that are found, whatever lies in the scene's folder."""

    def __init__(self, find: Find, folder: Path) -> None:
        super().__init__(folder)
        self._find = find

    def function(self, module: str, name: str) -> Callable[..., Any]:
        return self._find(module, name)


def loaded(description: scenes.Scene, find: Find, rng: np.random.Generator) -> Scene:
    """A small scene, to be rendered as often as one likes with the functions that are found."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(yaml.safe_dump(description), encoding="utf-8")
        if "cross" in description.get("environment", {}):
            Image.fromarray(scenes.cross(rng)).save(path.with_name("cross.png"))
        if any("texture" in material for material in description["materials"].values()):
            Image.fromarray(scenes.paint(rng)).save(path.with_name(scenes.PAINT))
        if any("file" in thing for thing in description["objects"]):
            path.with_name(scenes.SHEET).write_text(scenes.sheet(rng), encoding="utf-8")
        functions = RecordedEffects(_Found(find, path.parent))
        with functions.building():
            return load_scene(path, functions)


def rendered(scene: Scene, **options: Any) -> Array:
    """The picture (3, H, W) of a small scene, linear."""
    # One thread: a tape is replayed in the order in which it was recorded.
    picture = render(scene, threads=1, compiled=False, **options).linear
    return np.ascontiguousarray(np.moveaxis(picture, -1, 0))


def noisy(function: str) -> bool:
    """Right functions that draw, or get random numbers, may give pictures that differ by noise."""
    return any(name in ("u", "rng") for name, _ in contract(function).arguments)


def picture_checks(path: str, make: MakeScene) -> tuple[Check, ...]:
    """The picture by SSIM and, where the function makes noise, its bias.

    Parameters
    ----------
    path : "module.function"
    make : describes the scene
    """
    module, function = path.split(".")

    def prepare(caller: Caller, rng: np.random.Generator) -> dict[str, Array]:
        tape: dict[str, Array] = {}
        stage = Stage(module, caller, function, recording=tape)
        scene = loaded(make(rng), stage.function, rng)
        return {"picture": rendered(scene)} | tape

    def run(trial: Trial) -> None:
        stage = Stage(module, trial.caller, function, tape=trial.references)
        scene = loaded(make(trial.rng), stage.function, trial.rng)
        try:
            yours = rendered(scene)
        except EffectError as error:
            # The renderer looks at some values itself: one that it can't go on with is the student's.
            raise StudentError("bad value", str(error)) from error
        expected = trial.references["picture"]
        trial.show("pictures", "The scene", yours=yours, expected=expected)
        check_ssim(yours, expected, f"{path}/picture")

    looks = Check(
        function,
        "picture",
        "The picture looks like the reference",
        run,
        kind="picture",
        points=2,
        prepare=prepare,
    )
    if not noisy(path):
        return (looks,)

    def drawing(
        description: scenes.Scene, stage: Stage, rng: np.random.Generator
    ) -> Callable[..., Array]:
        """Draws the same scene with any seed."""
        return partial(rendered, loaded(description, stage.function, rng), spp=BIAS_SAMPLES)

    def prepare_bias(caller: Caller, rng: np.random.Generator) -> dict[str, Array]:
        description = make(rng)
        first = int(rng.integers(1 << 20))
        tape: dict[str, Array] = {}
        draw = drawing(description, Stage(module, caller, function, recording=tape), rng)
        # The student's pictures, for the tape alone; there is none where nothing comes before the function.
        for number in range(BIAS_PICTURES):
            draw(seed=first + number)
            if not tape:
                break
        seeds = range(first + BIAS_PICTURES, first + BIAS_PICTURES + BIAS_REFERENCES)
        return {"blocks": np.stack([block_means(draw(seed=seed)) for seed in seeds])} | tape

    def run_bias(trial: Trial) -> None:
        description = make(trial.rng)
        first = int(trial.rng.integers(1 << 20))
        stage = Stage(module, trial.caller, function, tape=trial.references)
        draw = drawing(description, stage, trial.rng)
        check_bias(
            [draw(seed=first + number) for number in range(BIAS_PICTURES)],
            trial.references["blocks"],
        )

    bias = Check(
        function,
        "bias",
        "The picture's brightness is right everywhere on average",
        run_bias,
        kind="bias",
        points=1,
        false_fail=BIAS_FALSE_FAIL,
        prepare=prepare_bias,
    )
    return looks, bias
