"""The hierarchy of the bounding_volumes module, where the scene asks for it."""

from __future__ import annotations

from collections.abc import Iterator

from course.building.motion import Shutter
from course.core.functions import Functions
from course.effects import Bound
from course.formats.yaml import description as d
from course.formats.yaml.document import KeyPath, spell
from course.formats.yaml.loading import Loaded

FUNCTIONS = ("build", "traverse")
"""The functions of bounding_volumes that are called."""


def compile_acceleration(
    loaded: Loaded, shutter: Shutter, bound: Bound
) -> tuple[Functions, int] | None:
    """The module's functions and the size of a leaf; None where Embree answers, and then nothing of it is imported.

    Raises SceneError: something that rays meet moves while the shutter is open; names the key.
    """
    scene = loaded.description
    if scene.acceleration.type == "embree":
        return None
    for path, motion in _motions(scene):
        if shutter.moves(motion):
            raise loaded.document.error(
                ("acceleration", "type"),
                f"a hierarchy holds what stands still, and {spell(path)} moves while the shutter is open;"
                " leave its motion out, or take embree",
            )
    asked_by = ("acceleration", "type")
    functions = bound.functions("bounding_volumes", *FUNCTIONS, asked_by=asked_by)
    return functions, scene.acceleration.leaf_size


def _motions(scene: d.SceneDescription) -> Iterator[tuple[KeyPath, d.MotionDescription]]:
    """Of everything that rays meet: objects, and lights that are surfaces."""
    for number, thing in enumerate(scene.objects):
        yield ("objects", number), thing.motion
    for number, light in enumerate(scene.lights):
        if isinstance(light, d.RectangleLight | d.SphereLight) and light.radiance is not None:
            yield ("lights", number), light.motion
