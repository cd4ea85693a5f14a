"""Scenes with some values replaced, ready to be rendered."""

from __future__ import annotations

from pathlib import Path

from course.building.world import compile_scene
from course.effects import Effects
from course.formats.yaml.loading import load_description
from course.formats.yaml.overriding import Overrides
from course.scene.scene import Scene


def load_variant(
    path: str | Path,
    overrides: Overrides | None = None,
    effects: str | Path | Effects | None = None,
) -> Scene:
    """What `course.load_scene` makes of a scene file, with other values at some key paths.

    Parameters
    ----------
    path, effects : as `course.load_scene` takes them
    overrides : key path -> value, such as ``{("lights", 0, "samples"): "ball"}``

    Raises
    ------
    SceneError, EffectError
        As `course.load_scene` does, and for an override of something that isn't there.
    """
    bound = effects if isinstance(effects, Effects) else Effects(effects)
    loaded = load_description(Path(path), overrides)
    return Scene(loaded, compile_scene(loaded, bound), bound)
