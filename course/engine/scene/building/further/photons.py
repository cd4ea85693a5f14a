"""Photons of a scene: which lights send them, at what, and what is told before they are sent."""

import warnings
from dataclasses import replace

import numpy as np

from course.base.errors import CourseWarning
from course.base.texts import count
from course.engine.core.materials import Lookup, MaterialTable
from course.engine.core.motion import MovingAccelerator
from course.engine.core.types import Floats32, Floats64, Mask
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame
from course.engine.scene.building.materials import material_columns
from course.engine.scene.building.things import Things
from course.engine.terms.photons.emission import (
    Daylight,
    Lamp,
    Target,
    can_emit,
    functions_for,
)
from course.engine.terms.photons.maps import Estimate
from course.engine.terms.photons.passes import MOST
from course.engine.terms.photons.stage import PhotonSettings, PhotonStage
from course.engine.terms.world import FullWorld

KEY = ("photons",)

LONG = 20_000_000
"""Photons of a pass from which on the time that they take is told."""

SECONDS = 2e-6
"""Of one photon."""


def compiled(
    loaded: Loaded, frame: Frame, bound: Bound, things: Things, world: FullWorld
) -> FullWorld:
    """The world with its photons.

    Raises SceneError: there is fog, paths are to gather, a filter is asked for that isn't used; names the key.
    """
    del things
    scene = loaded.description
    asked = scene.photons
    assert asked is not None
    _check(loaded, asked, world)
    materials = world.materials
    optical = np.asarray(materials.refracts | (materials.mirror.max(axis=0) > 0))
    lights: tuple[Lamp, ...] = tuple(light for light in world.lights if can_emit(light))
    if world.sky is not None and world.environment is not None:
        lights = (*lights, Daylight(world.environment, world.sky))
    target = _ball(world, optical)
    caustics = target is not None or asked.gather
    if not (caustics and lights and materials.diffuses.any() and scene.integrator.max_depth):
        nothing = "no light sends any"
        if not caustics:
            nothing = "nothing mirrors or refracts"
        elif not materials.diffuses.any():
            nothing = "nothing is matte"
        elif not scene.integrator.max_depth:
            nothing = "no surface sends light on (integrator.max_depth is 0)"
        _tell(loaded, f"{nothing}: there are no caustics, and no photons are sent")
        return world
    _tell_what_is_left_out(loaded, world)
    radius = None if asked.radius is None else asked.radius / frame.scale
    estimate = Estimate(asked.cone, asked.nearest)
    known = asked.count, radius, asked.alpha, estimate, asked.samples, asked.gather
    names = functions_for(lights) | {"roulette", "stored", "shrunk_radius"} | estimate.functions
    names |= {"final_gather"} if asked.gather else set()
    module = bound.functions("photon_mapping", *sorted(names), asked_by=KEY)
    where = f"{loaded.document.where(KEY)}: photons"
    glow = _unsampled(loaded, materials)
    if asked.gather and glow.any():
        _tell(
            loaded,
            "what glows and is no light sends no photons: its light goes to other surfaces, and no further; add"
            " {type: object, object: its name} to lights",
        )
    everything = _ball(world, np.ones_like(optical))
    assert everything is not None
    stage = PhotonStage(
        PhotonSettings(*known),
        lights,
        world.motion,
        materials.diffuses,
        materials.refracts,
        Lookup(materials.diffuse),
        Lookup(glow) if glow.any() else None,
        target,
        everything,
        module,
        where,
    )
    combining = world.combining if world.paths is None else None
    return replace(world, wraps=(*world.wraps, stage), combining=combining)


def _unsampled(loaded: Loaded, materials: MaterialTable) -> Floats32:
    """Radiance (3, M) of surfaces that shine and that no light samples."""
    sampled = np.zeros(materials.emission.shape[1], np.bool_)
    sampled[list(material_columns(loaded.description).of_lights.values())] = True
    if materials.lamps is not None:
        sampled |= materials.lamps
    return np.asarray(materials.emission * ~sampled, np.float32)


def _check(loaded: Loaded, asked: d.PhotonsDescription, world: FullWorld) -> None:
    """Refuse what isn't done together with photons, or would have no effect."""
    document = loaded.document
    if loaded.description.media:
        raise document.error(
            KEY, "expected null in a scene with media: photons know light between surfaces alone"
        )
    if asked.gather and world.paths is not None:
        raise document.unexpected(
            (*KEY, "gather"), "0 where the integrator is path: its own rays find what others gather"
        )
    if asked.nearest is not None and "cone" in document.value(KEY):
        raise document.error(
            (*KEY, "cone"), "expected none beside nearest: the nearest photons count alike"
        )


def _ball(world: FullWorld, materials: Mask) -> Target | None:
    """The ball around all triangles of some materials (M,); None where there are none."""
    triangles = world.surface.triangles
    planes, edges = (a.astype(np.float64) for a in (triangles.planes, triangles.edges))
    corners = np.stack((planes[:, :3], planes[:, :3] + edges[:, :3], planes[:, :3] + edges[:, 3:6]))
    shines = materials.take(triangles.material)
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
    if asked.count >= LONG:
        took = round(asked.count * SECONDS * (2 if asked.gather else 1))
        long = count(took, "second") if took < 120 else count(round(took / 60), "minute")
        _tell(
            loaded,
            f"{asked.count:,} photons in each pass take about {long} a pass; at most"
            f" {MOST:,} of a pass are kept, and then no more are sent",
        )
    others = [light.name for light in world.lights if not can_emit(light)]
    if others:
        _tell(
            loaded,
            f"{', '.join(others)}: it isn't known where photons leave; no caustics of its light",
        )
    # Rays of paths that have come by mirrors from matte surfaces would see it, if photons didn't stand for them.
    if world.paths is not None and world.environment and world.sky is None and not world.backdrop:
        _tell(
            loaded,
            "no photons leave an environment that lights no surface, and no caustics are of its light: set"
            " environment.lights",
        )
    combined = loaded.description.integrator.gloss_sampling != "automatic"
    if world.paths is not None and world.combining is not None and combined:
        _tell(
            loaded,
            "beside photons glossy surfaces look for lamps by the lobe alone; the picture is the same on average",
        )


def _tell(loaded: Loaded, what: str) -> None:
    warnings.warn(f"{loaded.document.where(KEY)}: photons: {what}", CourseWarning, stacklevel=2)
