"""What moves while the shutter is open, and the functions that it takes."""

from __future__ import annotations

import numpy as np

from course.effects import Effects
from course.geometry.motion_functions import MotionFunctions
from course.scene import description as d
from course.scene.frame import Frame
from course.scene.loading import Loaded
from course.scene.shutter import Shutter
from course.scene.world import Motion


def movers(loaded: Loaded, shutter: Shutter) -> list[tuple[str | int, ...]]:
    """Key paths of everything that moves while the shutter is open."""
    scene = loaded.description
    found: list[tuple[str | int, ...]] = []
    for number, thing in enumerate(scene.objects):
        if shutter.moves(thing.motion):
            found.append(("objects", number, "motion"))
    for number, light in enumerate(scene.lights):
        if not isinstance(light, d.AmbientLight | d.DirectionalLight) and shutter.moves(
            light.motion
        ):
            found.append(("lights", number, "motion"))
    if shutter.moves(scene.camera.motion):
        found.append(("camera", "motion"))
    return found


def compile_motion(
    loaded: Loaded, frame: Frame, shutter: Shutter, effects: Effects
) -> Motion | None:
    """None where nothing moves, and then the motion_blur module is not even imported."""
    if not movers(loaded, shutter):
        return None
    camera = loaded.description.camera.motion
    velocity = None
    if shutter.moves(camera):
        velocity = np.array(shutter.velocity(camera, frame), np.float32)
    return Motion(
        shutter.duration,
        MotionFunctions(
            effects.function("motion_blur", "shutter_times"),
            effects.function("motion_blur", "displacement"),
            effects.function("motion_blur", "to_object_space"),
        ),
        velocity,
    )
