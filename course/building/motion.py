"""What moves while the shutter is open, and the functions that it takes."""

from __future__ import annotations

import numpy as np

from course.building.frame import Frame
from course.building.light_power import why_dark
from course.building.ranges import in_reach
from course.building.shutter import Shutter
from course.core.materials import MaterialTable
from course.core.motion import Motion
from course.effects import Bound
from course.formats.yaml import description as d
from course.formats.yaml.loading import Loaded


def movers(
    loaded: Loaded, shutter: Shutter, materials: MaterialTable
) -> list[tuple[tuple[str | int, ...], bool]]:
    """Key paths of all that moves while the shutter is open, and that anybody could see moving; whether rays meet it.

    A light by radiance is a surface, and hides things even if it lights nothing; others only count if they light.
    """
    scene = loaded.description
    found: list[tuple[tuple[str | int, ...], bool]] = []
    for number, thing in enumerate(scene.objects):
        if shutter.moves(thing.motion):
            found.append((("objects", number, "motion"), True))
    for number, light in enumerate(scene.lights):
        # What moves of an object that is a light is the object.
        if isinstance(light, d.AmbientLight | d.DirectionalLight | d.ObjectLight):
            continue
        surface = not isinstance(light, d.PointLight) and light.radiance is not None
        surface = surface and not (isinstance(light, d.RectangleLight) and not light.visible)
        if shutter.moves(light.motion) and (surface or not why_dark(light, materials)):
            found.append((("lights", number, "motion"), surface))
    if shutter.moves(scene.camera.motion):
        found.append((("camera", "motion"), False))
    return found


def check_sweeps(loaded: Loaded, frame: Frame, shutter: Shutter) -> None:
    """SceneError for a light or a camera that moves too far for float32; objects set the scene's size themselves."""
    camera, lights = loaded.description.camera, loaded.description.lights
    moved: list[tuple[tuple[str | int, ...], d.MotionDescription]] = [
        (("lights", number), light.motion)
        for number, light in enumerate(lights)
        if not isinstance(light, d.AmbientLight | d.DirectionalLight | d.ObjectLight)
    ]
    for path, motion in [(("camera",), camera.motion), *moved]:
        in_reach(
            frame.vector(shutter.sweep(motion)),
            loaded,
            (*path, "motion", "velocity"),
            "the way it moves while the shutter is open",
        )


def compile_motion(
    loaded: Loaded, frame: Frame, shutter: Shutter, bound: Bound, materials: MaterialTable
) -> Motion | None:
    """None where nothing moves, and then the motion_blur module is not even imported."""
    moving = movers(loaded, shutter, materials)
    if not moving:
        return None
    first, _ = moving[0]
    surfaces = [path for path, surface in moving if surface]
    camera = loaded.description.camera.motion
    velocity = None
    if shutter.moves(camera):
        velocity = np.array(shutter.velocity(camera, frame), np.float32)
    names = ["shutter_times", "displacement"]
    if surfaces:
        # Noted with what asks for it, which may be another thing than what moves first.
        bound.function("motion_blur", "to_object_space", surfaces[0])
        names.append("to_object_space")
    return Motion(bound.functions("motion_blur", *names, asked_by=first), velocity)
