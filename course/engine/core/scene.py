"""The compiled scene (centred, scaled to [-1, 1], in float32), its render settings, and the stages that it needs.

Stages and random numbers are planned once, before the first ray.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.core.blinn_phong import BlinnPhong
from course.engine.core.camera import Camera
from course.engine.core.direct import DirectLight
from course.engine.core.environment import Environment
from course.engine.core.gloss import Gloss, Lobe
from course.engine.core.hits import Surface
from course.engine.core.integrator import Integrator
from course.engine.core.lights.sample import Light
from course.engine.core.materials import Lookup, MaterialTable
from course.engine.core.motion import Motion
from course.engine.core.rays import Dimensions
from course.engine.core.scatter import Scatter
from course.engine.core.types import Floats32


@dataclass(frozen=True)
class World:
    """The compiled scene.

    Attributes
    ----------
    surface : all triangles
    lights : the lights that illuminate something
    ambient : (3,) float32, sum of the ambient lights
    environment : radiance of the rays that hit nothing; None if it is black
    lobes : the lobes of the glossy materials
    motion : None if nothing moves while the shutter is open
    """

    surface: Surface
    materials: MaterialTable
    lights: tuple[Light, ...]
    ambient: Floats32
    environment: Environment | None
    lobes: tuple[Lobe, ...] = ()
    motion: Motion | None = None


@dataclass(frozen=True)
class Settings:
    """Render settings.

    Attributes
    ----------
    width, height : size of the picture [pixels]
    sampler : name of the sampler
    samples : samples per pixel
    max_depth : largest number of bounces after the camera ray
    cutoff : bounced rays are dropped unless their largest throughput channel is above this
    """

    width: int
    height: int
    sampler: str
    samples: int
    seed: int
    max_depth: int
    cutoff: float


def plan_dimensions(
    world: World,
    camera: Camera,
    before_lights: Sequence[tuple[str, int]] = (),
    after_lights: Sequence[tuple[str, int]] = (),
) -> Dimensions:
    """Dimensions of the sampler for all random numbers.

    Dimensions 2 and 3 are stratified jointly with the pixel's (``course.engine.terms.samplers.sobol``). They go to the
    first of these that the scene uses: lens, time, gloss, ``before_lights``, lights. Gloss comes before lights: noise
    is more visible in mirror images than in shadows. ``before_lights`` and ``after_lights`` are names and widths of
    further numbers that a bounce draws.
    """
    of_path = [("pixel", 2), ("lens", 2 if camera.lens else 0), ("time", 1 if world.motion else 0)]
    gloss = ("gloss", max((lobe.width for lobe in world.lobes), default=0))
    lights = [(light.name, light.width) for light in world.lights]
    return Dimensions(of_path, [gloss, *before_lights, *lights, *after_lights])


def plan_direct_light(world: World, sky: bool = False) -> DirectLight | None:
    """Direct light; None without lights or without a material that reflects them.

    ``sky`` is true if the caller adds the environment as a light later: then the result is never None.
    """
    materials = world.materials
    if not sky and not (world.lights and materials.shaded.any()):
        return None
    return DirectLight(
        world.surface,
        world.lights,
        world.motion,
        None if materials.shaded_sides.all() else materials.shaded_sides,
        BlinnPhong(
            Lookup(materials.diffuse),
            Lookup(materials.specular) if materials.specular.any() else None,
            Lookup(materials.exponent),
        ),
    )


def plan_scatter(world: World, max_depth: int, cutoff: float) -> Scatter | None:
    """Reflection and refraction; None if no material does either, or if ``max_depth`` is 0."""
    materials = world.materials
    refracts = bool(materials.refracts.any())
    if max_depth == 0 or not (refracts or bool((materials.mirror.max(0) > cutoff).any())):
        return None
    return Scatter(
        world.surface,
        Lookup(materials.mirror),
        Lookup(materials.refraction_index) if refracts else None,
        Gloss(world.lobes) if world.lobes else None,
        refracts and bool(materials.absorption.any()),
        materials.outside,
        cutoff,
    )


def plan_integrator(
    world: World, camera: Camera, depth: int, direct: DirectLight | None, scatter: Scatter | None
) -> Integrator:
    """The integrator for at most ``depth`` bounces; stages that the scene doesn't need are None."""
    materials = world.materials
    ambient = materials.ambient * world.ambient[:, None]
    shows = materials.diffuses | ambient.any(0)
    lamps = False if materials.lamps is None else materials.lamps
    return Integrator(
        surface=world.surface,
        camera=camera,
        motion=world.motion,
        environment=world.environment,
        environment_depth=-1 if world.environment is None else depth,
        direct=direct,
        ambient=_unless_nothing(ambient),
        dark_inside=materials.refracts if (materials.refracts & shows).any() else None,
        glow=_unless_nothing(materials.emission * np.logical_not(lamps)),
        emission=_unless_nothing(materials.emission * lamps),
        absorption=None,
        scatter=scatter,
        max_depth=depth,
    )


def _unless_nothing(rows: Floats32) -> Lookup | None:
    return Lookup(rows) if rows.any() else None
