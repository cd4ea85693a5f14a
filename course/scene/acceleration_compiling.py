"""The hierarchy of the bounding_volumes module, where the scene asks for it."""

from __future__ import annotations

from collections.abc import Iterator

from course.effects import Bound
from course.geometry.hierarchy import HierarchyFunctions
from course.scene import description as d
from course.scene.document import KeyPath, spell
from course.scene.loading import Loaded
from course.scene.shutter import Shutter

FUNCTIONS = ("build", "traverse")
"""The functions of bounding_volumes that are called."""


def compile_acceleration(
    loaded: Loaded, shutter: Shutter, bound: Bound
) -> HierarchyFunctions | None:
    """None where Embree answers, and then the bounding_volumes module is not even imported.

    Raises
    ------
    SceneError
        Something that rays meet moves while the shutter is open; names the key.
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
    build, traverse = (
        bound.function("bounding_volumes", name, ("acceleration", "type")) for name in FUNCTIONS
    )
    return HierarchyFunctions(build, traverse, scene.acceleration.leaf_size)


def _motions(scene: d.SceneDescription) -> Iterator[tuple[KeyPath, d.MotionDescription]]:
    """Of everything that rays meet: objects, and lights that are surfaces."""
    for number, thing in enumerate(scene.objects):
        yield ("objects", number), thing.motion
    for number, light in enumerate(scene.lights):
        if isinstance(light, d.RectangleLight | d.SphereLight) and light.radiance is not None:
            yield ("lights", number), light.motion
