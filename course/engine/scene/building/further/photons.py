"""Photons of a scene: which lights send them, at what, and what is told before they are sent."""

import warnings
from dataclasses import replace

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.motion import MovingAccelerator
from course.engine.core.types import Floats64, Mask
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame
from course.engine.scene.building.things import Things
from course.engine.terms.photons.emission import Target, can_emit, functions_for
from course.engine.terms.photons.stage import MOST, PhotonSettings, PhotonStage
from course.engine.terms.world import FullWorld

KEY = ("photons",)

MANY = 20_000_000
"""Photons of a pass from which on the time that they take is told."""

SHARE = 20
"""Radii of the first pass in that of the ball around mirrors and glass."""


def compiled(
    loaded: Loaded, frame: Frame, bound: Bound, things: Things, world: FullWorld
) -> FullWorld:
    """The world with its photons.

    Raises SceneError: there is fog; names the key.
    """
    del things
    scene = loaded.description
    asked = scene.photons
    assert asked is not None
    if scene.media:
        raise loaded.document.error(
            KEY, "expected null in a scene with media: photons know light between surfaces alone"
        )
    materials = world.materials
    optical = np.asarray(materials.refracts | (materials.mirror.max(axis=0) > 0))
    lights = tuple(light for light in world.lights if can_emit(light))
    target = _target(world, optical)
    if target is None or not lights or not materials.diffuses.any():
        nothing = "no light sends any"
        if target is None:
            nothing = "nothing mirrors or refracts"
        elif not materials.diffuses.any():
            nothing = "nothing is matte"
        _tell(loaded, f"{nothing}: there are no caustics, and no photons are sent")
        return world
    _tell_what_is_left_out(loaded, world)
    radius = target.radius / SHARE if asked.radius is None else asked.radius / frame.scale
    settings = PhotonSettings(asked.count, radius, asked.alpha, asked.cone, asked.samples)
    names = functions_for(lights) | {"roulette", "stored", "cone_weights", "shrunk_radius"}
    module = bound.functions("photon_mapping", *sorted(names), asked_by=KEY)
    where = f"{loaded.document.where(KEY)}: photons"
    arrays = materials.diffuses, materials.refracts
    stage = PhotonStage(settings, lights, world.motion, *arrays, target, module, where)
    combining = world.combining if world.paths is None else None
    return replace(world, wraps=(*world.wraps, stage), combining=combining)


def _target(world: FullWorld, optical: Mask) -> Target | None:
    """The ball around all triangles that mirror or refract; None where there are none."""
    triangles = world.surface.triangles
    planes, edges = (a.astype(np.float64) for a in (triangles.planes, triangles.edges))
    corners = np.stack((planes[:, :3], planes[:, :3] + edges[:, :3], planes[:, :3] + edges[:, 3:6]))
    shines = optical.take(triangles.material)
    if not shines.any():
        return None
    sweep = np.zeros((len(planes), 3))
    accelerator = world.surface.accelerator
    for mover in accelerator.movers if isinstance(accelerator, MovingAccelerator) else ():
        sweep[mover.first : mover.last] = mover.velocity
    both = np.concatenate((corners, corners + sweep))
    mine = both[:, shines].reshape(-1, 3)
    center = (mine.min(axis=0) + mine.max(axis=0)) / 2
    radius, reach = _farthest(mine, center), _farthest(both.reshape(-1, 3), center)
    # A little more than float32 may lose.
    return Target(center.astype(np.float32), radius * 1.0001, reach * 1.0001)


def _farthest(points: Floats64, center: Floats64) -> float:
    return float(np.sqrt(((points - center) ** 2).sum(axis=1).max()))


def _tell_what_is_left_out(loaded: Loaded, world: FullWorld) -> None:
    asked = loaded.description.photons
    assert asked is not None
    if asked.count >= MANY:
        _tell(
            loaded,
            f"{asked.count:,} photons in each pass take about {asked.count * 2e-6 / 60:.0f} minutes a pass; at most"
            f" {MOST:,} of a pass are kept, and then no more are sent",
        )
    others = [light.name for light in world.lights if not can_emit(light)]
    if others:
        _tell(
            loaded,
            f"{', '.join(others)}: it isn't known where photons leave; no caustics of its light",
        )
    if world.paths is not None and world.environment is not None:
        _tell(loaded, "no photons come from the environment; caustics of its light are left out")
    combined = loaded.description.integrator.gloss_sampling != "automatic"
    if world.paths is not None and world.combining is not None and combined:
        _tell(
            loaded,
            "beside photons glossy surfaces look for lamps by the lobe alone; the picture is the same on average",
        )


def _tell(loaded: Loaded, what: str) -> None:
    warnings.warn(f"{loaded.document.where(KEY)}: photons: {what}", CourseWarning, stacklevel=2)
