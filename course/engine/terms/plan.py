"""The plan of a scene with extras: the core's stages, or fuller ones in their place where the scene asks for more."""

from dataclasses import fields, replace
from typing import Any

import numpy as np

from course.engine.core.camera import Camera
from course.engine.core.direct import DirectLight
from course.engine.core.integrator import Integrator
from course.engine.core.materials import Lookup, MaterialTable
from course.engine.core.rays import Dimensions
from course.engine.core.samplers import Sampler
from course.engine.core.scatter import Scatter
from course.engine.core.scene import (
    plan_dimensions,
    plan_direct_light,
    plan_integrator,
    plan_scatter,
)
from course.engine.terms.environments.sky import NUMBERS, Sky
from course.engine.terms.lights.light_choice import WHERE, WHICH, LightChoice
from course.engine.terms.lights.multiple_importance import CombiningIntegrator, plan_lamps_and_lobes
from course.engine.terms.paths.bounce import PathBounce
from course.engine.terms.paths.path_tracing import PathIntegrator, glow
from course.engine.terms.samplers.sobol import SobolSampler
from course.engine.terms.scattering.absorption import Absorption
from course.engine.terms.scattering.conductors import Conductors
from course.engine.terms.scattering.materials import FullMaterials
from course.engine.terms.scattering.microfacets import NUMBERS as MICROFACET
from course.engine.terms.scattering.reflection import FullReflection
from course.engine.terms.scattering.rough_glass import REFRACTION
from course.engine.terms.scattering.scatter import FullScatter
from course.engine.terms.world import FullWorld, Paths

BOUNCE, CHOICE = ("bounce", 2), ("choice", 2)
"""Numbers of a path: for the direction after a diffuse hit; for the choice of the bounce and for Russian roulette."""

PIECES = 16
"""Batches of rays in a tile: most paths end soon, and the few that are left of several batches make one."""


def same_fields(stage: Any) -> dict[str, Any]:
    """A stage's fields by name, for a fuller stage in its place."""
    return {each.name: getattr(stage, each.name) for each in fields(stage) if each.init}


def plan(
    world: FullWorld, camera: Camera, max_depth: int, cutoff: float, sampler: Sampler
) -> tuple[Integrator, Dimensions]:
    """The integrator of a scene, and the dimensions of its random numbers."""
    paths = world.paths
    scatter = _scatter(world, max_depth, cutoff if paths is None else 0.0)
    sky = _sky(world)
    direct = _direct_light(world, sky)
    diffuses = paths is not None and bool(world.materials.diffuses.any())
    depth = max_depth if scatter is not None or diffuses else 0
    integrator = plan_integrator(world, camera, depth, direct, scatter)
    if isinstance(world.materials, FullMaterials) and world.materials.unlit is not None:
        # Textures colour it as they do the ambient term, whose place it has.
        ambient = world.materials.unlit + world.materials.ambient * world.ambient[:, None]
        integrator = replace(integrator, ambient=Lookup(ambient))
    if world.backdrop:
        seen = min(integrator.environment_depth, 0)
        integrator = replace(integrator, environment_depth=seen)
    if scatter is not None and scatter.absorbs:
        integrator = replace(integrator, absorption=Absorption.of(world.materials, camera))
    full = scatter if isinstance(scatter, FullScatter) else None
    rough = [REFRACTION] if full and full.rough else []
    rough += [MICROFACET] if full and full.microfacets else []
    further = [NUMBERS] if sky is not None else []
    if direct is not None and isinstance(choice := direct.choice, LightChoice):
        further = [(WHICH, 1), (WHERE, choice.width), *further]
    if paths is not None:
        further += [BOUNCE, CHOICE] if diffuses and max_depth > 0 else [CHOICE]
        integrator = _path_integrator(integrator, world.materials, paths, sampler)
    if world.combining is not None and scatter is not None:
        both = plan_lamps_and_lobes(world.combining, world.surface, scatter, world.motion)
        if isinstance(integrator, PathIntegrator):
            integrator = replace(integrator, lamps_and_lobes=both)
        else:
            known = same_fields(integrator) | {"emission": None}
            integrator = CombiningIntegrator(
                **known, lamps_and_lobes=both, lamps=integrator.emission
            )
    for wrap in world.wraps:
        further += wrap.numbers(paths is not None)
        integrator = wrap.around(integrator, max_depth)
    # Of a choice among lights the numbers are its own, and no light's.
    drawing = world if world.choice is None else replace(world, lights=())
    return integrator, plan_dimensions(drawing, camera, rough, further)


def _scatter(world: FullWorld, max_depth: int, cutoff: float) -> Scatter | None:
    scatter = plan_scatter(world, max_depth, cutoff)
    conductors = _conductors(world.materials)
    if scatter is None or not (conductors or world.rough or world.microfacets or world.keeps):
        return scatter
    rough = world.rough if scatter.index is not None else ()
    return FullScatter(
        **same_fields(scatter),
        conductors=conductors,
        rough=rough,
        keeps=world.keeps,
        max_depth=max_depth,
        microfacets=world.microfacets,
    )


def _conductors(materials: MaterialTable) -> Conductors | None:
    return materials.conductors if isinstance(materials, FullMaterials) else None


def _sky(world: FullWorld) -> Sky | None:
    materials = world.materials
    if world.sky is None or world.environment is None or not materials.diffuses.any():
        return None
    arrays = materials.diffuses, materials.refracts
    return Sky(world.surface, world.environment, world.sky, *arrays)


def _direct_light(world: FullWorld, sky: Sky | None) -> DirectLight | None:
    materials = world.materials
    direct = plan_direct_light(world, sky is not None)
    choice = world.choice if world.lights else None
    if direct is None:
        return None
    shine = getattr(world.surface, "shine", None)
    full = materials if isinstance(materials, FullMaterials) else None
    if shine is not None or (full and (full.highlights or full.plain is not None)):
        known = same_fields(direct.reflection)
        reflection = FullReflection(**known)
        if full:
            reflection = replace(reflection, highlights=full.highlights, plain=full.plain)
        direct = replace(direct, reflection=reflection)
    return replace(direct, sky=sky, choice=choice)


def _path_integrator(
    integrator: Integrator, materials: MaterialTable, paths: Paths, sampler: Sampler
) -> PathIntegrator:
    looked_for = paths.lamps | paths.objects
    ambient = None if integrator.ambient is None else glow(integrator.ambient.rows)
    return PathIntegrator(
        **same_fields(integrator),
        bounce=PathBounce(
            integrator.surface,
            integrator.scatter,
            np.asarray(materials.refracts | (materials.mirror.max(axis=0) > 0)),
            Lookup(materials.diffuse),
            paths.path_tracing,
            paths.roulette,
        ),
        # Sobol points are each pixel's own; those of other samplers belong to a tile, which can't be divided.
        pieces=PIECES if isinstance(sampler, SobolSampler) and paths.together else 1,
        unsought=glow(materials.emission * ~looked_for),
        reflected=ambient,
        lamps=glow(materials.emission * paths.lamps),
        objects=glow(materials.emission * paths.objects),
    )
