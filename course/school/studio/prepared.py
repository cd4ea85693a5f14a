"""A compiled scene of which some values change: what needs no new world is changed at once."""

from collections.abc import Mapping
from dataclasses import replace
from math import sqrt
from pathlib import Path
from typing import Any

from course.engine.formats.yaml.loading import load_description
from course.engine.functions.effects import Bound, Effects
from course.engine.scene.building.cameras import compile_lens
from course.engine.scene.building.world import compile_scene
from course.engine.scene.scene import Scene, SceneSettings

AT_ONCE = (
    ("camera", "eye"),
    ("camera", "look_at"),
    ("camera", "lens"),
    ("sampler",),
    ("film",),
)
"""Beginnings of key paths that the compiled world doesn't hang on, but for its lens."""

PIXELS = 480 * 320
"""The most of a picture."""

Values = Mapping[tuple[str | int, ...], Any]
"""Key path -> the value in the place of the file's."""


def fitting(width: int, height: int) -> tuple[int, int]:
    """Width and height of the studio's picture, of the same shape as the scene's."""
    scale = min(1.0, sqrt(PIXELS / (width * height)))
    return max(1, round(width * scale)), max(1, round(height * scale))


def changed(scene: Scene, before: Values, values: Values) -> Scene | None:
    """The scene with other values; None if its world has to be compiled again.

    Raises SceneError: a value is none that may stand there.
    """
    differ = {path for path in {*before, *values} if before.get(path) != values.get(path)}
    if not all(any(path[: len(head)] == head for head in AT_ONCE) for path in differ):
        return None
    if any(each.from_behind == "unseen" for each in scene.loaded.description.objects):
        return None
    loaded = load_description(scene.path, dict(values))
    bound = Bound(scene.effects, scene.compiled.needs)
    lens = compile_lens(loaded, scene.compiled.frame, bound)
    world = replace(scene.compiled.world, lens=lens)
    return Scene(loaded, replace(scene.compiled, world=world, needs=bound.needs), scene.effects)


def prepared(path: Path, values: Values, effects: Effects) -> Scene:
    """The compiled scene."""
    loaded = load_description(path, dict(values))
    return Scene(loaded, compile_scene(loaded, effects), effects)


def settings_of(scene: Scene) -> SceneSettings:
    """Settings of the studio's pictures."""
    settings = scene.settings
    width, height = fitting(settings.width, settings.height)
    return replace(settings, width=width, height=height, error=None)
