"""Motion while the shutter is open: velocities, positions when it opens, and the functions of motion_blur.

Times are counted from the opening, in float32, in exposures: the shutter closes at 1. A velocity is then the
displacement while the shutter is open, which float32 can represent for any exposure. Motion before the opening is part
of the positions, in float64. If the exposure has no length, nothing moves.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.materials import MaterialTable
from course.engine.core.motion import Motion
from course.engine.core.types import Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame, frame_of, in_reach
from course.engine.scene.building.light_power import why_dark

STILL = (0.0, 0.0, 0.0)

FAR = 64.0
"""Half sizes of all objects beyond which a camera's way leaves them behind."""


@dataclass(frozen=True)
class Shutter:
    """When light is let in, in seconds.

    Attributes
    ----------
    common : velocity that is taken from all motion, in units of the scene file
    """

    open: float
    duration: float
    common: tuple[float, float, float] = STILL

    def start(self, motion: d.MotionDescription) -> Floats64:
        """(3,) how far something has gone when the shutter opens, in units of the scene file."""
        return np.array(motion.velocity) * self.open

    def sweep(self, motion: d.MotionDescription) -> Floats64:
        """(3,) how far it goes until the shutter closes."""
        return (np.array(motion.velocity) - self.common) * self.duration

    def with_camera(self, loaded: Loaded, boxes: Sequence[Floats64]) -> "Shutter":
        """The same, or with the camera's velocity in common where it goes far beyond all objects.

        Whatever is seen sharply then goes with it, and float32 would lose it on the way.

        ``boxes`` : (2, 3) each, of the objects when the shutter opens
        """
        velocity = loaded.description.camera.motion.velocity
        way = np.abs(np.array(velocity) * self.duration).max()
        if not boxes or not way > FAR * frame_of(boxes).scale:
            return self
        x, y, z = velocity
        return replace(self, common=(x, y, z))

    def moves(self, motion: d.MotionDescription) -> bool:
        """True if it moves while the shutter is open."""
        return bool(self.sweep(motion).any())

    def velocity(self, motion: d.MotionDescription, frame: Frame) -> tuple[float, float, float]:
        """Velocity in units of the compiled scene an exposure; zero where nothing moves."""
        if not self.moves(motion):
            return STILL
        x, y, z = (float(v) for v in frame.vector(self.sweep(motion)))
        return (x, y, z)


def shutter_of(loaded: Loaded) -> Shutter:
    """The camera's shutter; SceneError if it closes before it opens."""
    shutter = loaded.description.camera.shutter
    if shutter.close < shutter.open:
        raise loaded.document.unexpected(
            ("camera", "shutter", "close"),
            f"a time not before camera.shutter.open, {shutter.open:g}",
        )
    return Shutter(shutter.open, shutter.close - shutter.open)


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
        # If an object is a light, it is the object that moves; other lights without a place don't move either.
        if not hasattr(light, "motion"):
            continue
        surface = getattr(light, "radiance", None) is not None
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
        if hasattr(light, "motion")
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
