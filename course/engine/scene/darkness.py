"""Pictures that are or are likely to be black, told before they are rendered.

Where nothing shines a picture is black for certain. Else a few rays are sent from the eye, straight through the picture
and all around, from what they meet to the lamps, and, where light goes from wall to wall, on from there at random. If
none finds any light, the mistake shows in what they met: the eye or the lamps stand inside something solid, something
stands before the lamps, or what is seen and the lamps are turned away from each other. No function of a student is
called, and where the rays leave any doubt nothing is said.
"""

import warnings
from functools import partial
from pathlib import Path
from typing import get_args

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.accelerator import QueryStats, StaticAccelerator
from course.engine.core.camera import Camera
from course.engine.core.hits import Hits
from course.engine.core.types import Floats32, Floats64
from course.engine.formats.yaml import description as d
from course.engine.loops.packets import packets_of
from course.engine.scene.building.cameras import compile_camera
from course.engine.scene.building.light_power import power
from course.engine.scene.finding_light import reached, shining
from course.engine.scene.lamp_points import AROUND, is_known
from course.engine.scene.scene import Scene
from course.engine.scene.unlit import LIKELY, hidden, locked_in, solids_around, turned_from
from course.engine.terms.world import FullWorld

GRID, FINE = 12, 96
"""Rays in each direction of the picture; the more where the fewer find no light."""


def why_black(scene: Scene) -> str:
    """Say why every picture of a scene is black for want of light; empty where there is some."""
    world, lights = scene.compiled.world, scene.loaded.description.lights
    if world.lights or shining(world).any() or world.environment is not None:
        return ""
    if not lights:
        kinds = ", ".join(str(kind.__struct_config__.tag) for kind in get_args(d.Light))
        return (
            "the picture will be black: the scene has no lights, and its environment is black; "
            f"known are {kinds}, such as {{type: ambient, radiance: 1}}"
        )
    reasons = dict(world.skipped_lights)
    for number, light in enumerate(lights):
        if isinstance(light, d.AmbientLight):
            dark = not power(light).any()
            reasons[f"light {number}"] = (
                "it has no power" if dark else "no material has an ambient term"
            )
    listed = [f"{name}: {reason}" for name, reason in list(reasons.items())[:3]]
    return (
        "the picture will be black: the environment is black, and no light shows anything "
        f"({'; '.join(listed)}{'; ...' if len(reasons) > 3 else ''})"
    )


def warn_of_darkness(scene: Scene, path: Path, packets: bool = False) -> bool:
    """Warn, once, of a picture that will be or is likely to be black; ``path`` is what the scene is called.

    Returns whether it did.
    """
    reason = why_dark(scene, packets)
    if reason:
        warnings.warn(f"{path}: {reason}", CourseWarning, stacklevel=2)
    return bool(reason)


def why_dark(scene: Scene, packets: bool = False) -> str:
    """Say why a scene's picture is likely to be black; empty where it isn't, or nobody can tell from a few rays.

    ``packets``: whether rays are asked of the hierarchy of compiled loops, for those will render the picture
    """
    world = scene.compiled.world
    reason = why_black(scene)
    # What moves, and the student's hierarchy, would call the student's functions.
    if reason or not isinstance(world.surface.accelerator, StaticAccelerator):
        return reason
    # Light that comes from between surfaces is met by none of these rays.
    if world.wraps or not all(map(is_known, world.lights)):
        return ""
    film = scene.settings
    camera = compile_camera(scene.loaded, scene.compiled.frame, film.width, film.height)
    met = partial(_met, world, packets)
    for grid in (GRID, FINE):
        seen = met(*_seen(camera, film.width, film.height, grid))
        if seen.size == 0:
            # Between the objects around it a camera may look out at the sky.
            if world.environment is None and _sees_nothing(scene, camera, film.width, film.height):
                return (
                    "the picture will be black: no object is in front of the camera, and the environment is black; "
                    "turn camera.look_at"
                )
            return ""
        if (seen.size < grid * grid and world.environment is not None) or reached(world, met, seen):
            return ""
    around = met(camera.origin[:, None], AROUND)
    inside = solids_around(scene, camera.origin[:, None], around, world.lights)
    if inside:
        return f"{LIKELY}the camera stands inside {inside}, and no light does; move camera.eye"
    turned_away = turned_from(scene, seen) if world.lights else ""
    # Through a wide lens more is seen than by the middle of it.
    return (
        turned_away
        if world.lens is not None
        else locked_in(scene, met) or turned_away or hidden(world)
    )


def _met(world: FullWorld, packets: bool, origin: Floats32, direction: Floats32) -> Hits:
    accelerator = world.surface.accelerator
    assert isinstance(accelerator, StaticAccelerator)
    if packets and len(accelerator.triangles):
        found = packets_of(accelerator).few(origin, direction)
    else:
        found = accelerator.intersect(origin, direction, QueryStats())
    return world.surface.hits(found, direction)


def _seen(camera: Camera, width: int, height: int, grid: int) -> tuple[Floats32, Floats32]:
    """Origins and directions of rays through the centres of grid x grid parts of the picture."""
    steps = (np.arange(grid, dtype=np.float32) + np.float32(0.5)) / grid
    x, y = np.repeat(steps, grid) * np.float32(width), np.tile(steps, grid) * np.float32(height)
    return camera.rays(x.astype(np.float32), y.astype(np.float32), None, None)


def _sees_nothing(scene: Scene, camera: Camera, width: int, height: int) -> bool:
    """True if all objects lie outside the pyramid of the picture; rays alone may miss small objects."""
    surfaces = any(getattr(light, "radiance", None) for light in scene.loaded.description.lights)
    if surfaces or scene.compiled.world.lens is not None:
        return False
    x, y = np.array([[0, width, width, 0], [0, 0, height, height]], np.float32)
    edges = camera.directions(x, y).T.astype(np.float64)
    sides = np.cross(edges, np.roll(edges, -1, axis=0))
    sides *= np.sign(sides @ edges.sum(axis=0))[:, None]
    inwards = np.concatenate((sides, edges.sum(axis=0)[None]))
    for box in scene.compiled.bounds:
        corners = _corners(scene.compiled.frame.position(box))
        if not (inwards @ (corners - camera.origin[:, None]) < 0).all(axis=1).any():
            return False
    return True


def _corners(points: Floats64) -> Floats64:
    """The corners (3, 8) of the box around points (k, 3)."""
    ends = np.stack((points.min(axis=0), points.max(axis=0)), axis=1)
    return np.stack(np.meshgrid(*ends)).reshape(3, -1)
