"""Direct light: for each light one point on it, one occlusion query, and Blinn-Phong reflection.

Symbols: l the vector to the light (not normalised), d its length, n the shading normal, v = -direction the way back
to the viewer, h the half vector between l and v.
"""

from __future__ import annotations

import numpy as np

from course.appearance.lights import Light
from course.appearance.lights.sample import TO_THE_LIGHT
from course.appearance.materials import Lookup
from course.core.types import Floats32, Indices, Mask
from course.core.vectors import dot
from course.geometry.hits import Hits, bulge
from course.scene.world import World
from course.transport import costs
from course.transport.counters import Counters
from course.transport.facing import Facing, facing, turned
from course.transport.paths import Draws
from course.transport.plan import Lookups, Plan
from course.transport.sky import skylight

_ROUNDING = 1e-4
"""Added to a sine before it is compared with a cosine, both in float32."""


def direct_light(
    world: World,
    plan: Plan,
    lookups: Lookups,
    hits: Hits,
    path: Indices | None,
    depth: int,
    draws: Draws,
) -> Floats32 | None:
    """Radiance (3, n) that the lights make visible at the hits; None where no light reaches any of them.

    Parameters
    ----------
    path : (n,) the path of each hit, or None for all paths of the block in order
    """
    diffuse: Floats32 | None = None
    specular: Floats32 | None = None
    for light, first in zip(world.lights, plan.light_dimensions, strict=True):
        u = None
        if first is not None:
            u = draws(light.name, first + depth * plan.bounce_stride, light.width, path)
        faced = _faced(world, plan, light, hits, u)
        if faced is None:
            continue
        irradiance = faced.strength
        irradiance *= _sees(world, light, hits, faced, draws.counters)
        draws.spend(costs.SHADOW_RAY, path, faced.lit)
        diffuse = _accumulated(diffuse, hits, faced, irradiance, light.color)
        if plan.specular:
            highlight = _highlight(hits, lookups, faced)
            highlight *= irradiance
            if world.materials.plain is not None:
                plain = world.materials.plain.take(faced.chosen(hits.material))
                highlight /= _cosine(hits, faced, plain)
            specular = _accumulated(specular, hits, faced, highlight, light.color)
    if plan.sky_dimension is not None:
        dimension = plan.sky_dimension + depth * plan.bounce_stride
        arriving = skylight(world, hits, path, dimension, draws)
        if arriving is not None:
            diffuse = arriving if diffuse is None else np.add(diffuse, arriving, out=diffuse)
    if diffuse is None:
        return None
    _scale(diffuse, hits, lookups.diffuse)
    if hits.tint is not None:
        diffuse *= hits.tint
    if specular is not None:
        specular *= lookups.specular(hits.material)
        diffuse += specular
    return diffuse


def _faced(world: World, plan: Plan, light: Light, hits: Hits, u: Floats32 | None) -> Facing | None:
    """The hits that can show light, face the light, and are faced by it: only these cast a shadow ray."""
    points = hits.p if world.lifted else hits.above
    if light.velocity is not None and world.motion is not None and hits.time is not None:
        # A light that has moved by d looks from p as one that stands still does from p - d.
        points = points - world.motion.functions.displacement(light.velocity, hits.time)
    sample = light.sample(points, u, hits.compiled)
    return facing(hits, sample, None if plan.all_shade else world.materials.shaded_sides)


def _sees(world: World, light: Light, hits: Hits, faced: Facing, counters: Counters) -> Mask:
    """Whether nothing stands between hits and the light; means nothing where a hit doesn't face it.

    Where a facet of a smooth mesh faces away from a light that its shading normal faces, the shadow ray starts from
    the round surface above the facet, provided that the way up there is free.
    """
    unoccluded = world.surface.accelerator.unoccluded
    time = None if hits.time is None else faced.chosen(hits.time)
    counters.rays["shadow"] += len(faced.lit)
    origin, to_light, asked = faced.origin, faced.to_light, faced.asked
    if to_light.shape[1] != origin.shape[1]:
        to_light = np.repeat(to_light, origin.shape[1], axis=1)
    near = light.limit <= TO_THE_LIGHT
    if world.lifted and near:
        # The light was looked at from the surface, the shadow ray starts above it.
        to_light = to_light + faced.chosen(hits.p) - origin
    query = light.limit, counters.embree
    if world.surface.bulge is None:
        return unoccluded(origin, to_light, *query, time, asked=asked)
    # The shading normal is within an angle of sine `bend` of the facet's: no other hits can face a light that their
    # facets turn away from.
    place = turned(hits, faced, to_light, np.float32(world.surface.bend + _ROUNDING))
    height = bulge(world.surface, hits, faced.hit(place))
    raised = np.flatnonzero(height)
    if len(raised) == 0:
        return unoccluded(origin, to_light, *query, time, asked=asked)
    place = place.take(raised)
    up = hits.ns.take(faced.hit(place), axis=1) * height.take(raised)
    foot = origin.take(place, axis=1)
    counters.rays["shadow"] += len(place)
    way_up = unoccluded(foot, up, 1.0, counters.embree, None if time is None else time.take(place))
    # Changed in place for the query and put back: only a few hits are raised, and copies of all would cost more.
    way = to_light.take(place, axis=1)
    origin[:, place] = foot + up
    if near:
        to_light[:, place] -= up
    free = unoccluded(origin, to_light, *query, time, asked=asked)
    origin[:, place] = foot
    to_light[:, place] = way
    free[place] &= way_up
    return free


def _highlight(hits: Hits, lookups: Lookups, faced: Facing) -> Floats32:
    """(n . h)^exponent at the hits that face the light."""
    half = faced.to_light * faced.inverse_length - faced.chosen(hits.direction)
    squared = dot(half, half)
    cosine = dot(half, faced.chosen(hits.ns))
    cosine /= np.sqrt(np.maximum(squared, np.float32(1e-12)))
    # Powers by exponential and logarithm, which NumPy computes ten times faster than `power`; below the smallest
    # argument the power is nothing anyway, except for exponent 0, where it is 1 for every cosine.
    np.clip(cosine, np.float32(1e-6), 1, out=cosine)
    np.log(cosine, out=cosine)
    cosine *= lookups.exponent(faced.chosen(hits.material))
    return np.exp(cosine, out=cosine)


def _cosine(hits: Hits, faced: Facing, wanted: Mask) -> Floats32:
    """Cosine between the normal and the way to the light where it is wanted, 1 elsewhere."""
    cosine = dot(faced.chosen(hits.ns), faced.to_light) * faced.inverse_length
    return np.where(wanted, np.maximum(cosine, np.float32(1e-20)), np.float32(1))


def _accumulated(
    total: Floats32 | None, hits: Hits, faced: Facing, values: Floats32, color: Floats32
) -> Floats32:
    """Add values of the hits that face the light, times a colour, to (3, n) of all hits."""
    if hits.compiled:
        from course.transport import direct_kernels

        if total is None:
            total = np.zeros((3, hits.size), np.float32)
        direct_kernels.spread(faced.lit, *map(np.ascontiguousarray, (values, color)), total)
        return total
    if faced.which is not None:
        spread = np.zeros(hits.size, np.float32)
        spread[faced.which] = values
        values = spread
    added: Floats32 = values * color[:, None]
    if total is None:
        return added
    total += added
    return total


def _scale(total: Floats32, hits: Hits, lookup: Lookup) -> None:
    """Multiply (3, n) of all hits by a property of their materials, in place."""
    if hits.compiled:
        from course.transport import direct_kernels

        direct_kernels.scale(total, np.ascontiguousarray(hits.material), lookup.rows)
        return
    total *= lookup(hits.material)
