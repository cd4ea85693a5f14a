"""Direct light: for each light one point on it, one occlusion query, and Blinn-Phong reflection.

Symbols: l the vector to the light (not normalised), d its length, n the shading normal, v = -direction the way back
to the viewer, h the half vector between l and v.
"""

from __future__ import annotations

import numpy as np

from course.appearance.lights import Light, Sample
from course.appearance.materials import Lookup
from course.core.types import Floats32, Indices, Mask
from course.core.vectors import dot
from course.geometry.hits import Hits, bulge
from course.scene.world import World
from course.transport import costs
from course.transport.counters import Counters
from course.transport.paths import Draws
from course.transport.plan import Lookups, Plan
from course.transport.sky import skylight

_ROUNDING = 1e-4
"""Added to a sine before it is compared with a cosine, both in float32."""

_ALL = np.empty((0, 0), np.bool_)


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
        lit = _irradiance(world, plan, light, hits, u, draws.counters)
        if lit is None:
            continue
        which, irradiance, to_light, inverse_length = lit
        draws.spend(costs.SHADOW_RAY, path, which)
        diffuse = _accumulated(diffuse, hits, which, irradiance, light.color)
        if plan.specular:
            highlight = _highlight(hits, lookups, which, to_light, inverse_length)
            highlight *= irradiance
            if world.materials.plain is not None:
                plain = world.materials.plain.take(hits.material.take(which))
                highlight /= _cosine(hits, which, to_light, inverse_length, plain)
            specular = _accumulated(specular, hits, which, highlight, light.color)
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


def _irradiance(
    world: World, plan: Plan, light: Light, hits: Hits, u: Floats32 | None, counters: Counters
) -> tuple[Indices, Floats32, Floats32, Floats32] | None:
    """Which hits the light reaches, its irradiance there, and the way to the light.

    Only hits that can show light, face the light, and are faced by it cast a shadow ray.
    """
    points = hits.above
    if light.velocity is not None and world.motion is not None and hits.time is not None:
        # A light that has moved by d looks from p as one that stands still does from p - d.
        points = points - world.motion.functions.displacement(light.velocity, hits.time)
    sample = light.sample(points, u, hits.compiled)
    shaded = None if plan.all_shade else world.materials.shaded_sides
    find = _facing_by_loop if hits.compiled else _facing
    faced = find(hits, sample, shaded)
    if faced is None:
        return None
    which, strength, cosine, origin, to_light, inverse_length = faced
    strength *= _sees(world, light, hits, which, cosine, origin, to_light, counters)
    return which, strength, to_light, inverse_length


_Facing = tuple[Indices, Floats32, Floats32, Floats32, Floats32, Floats32]
"""Which hits show light if nothing is in the way, how much, the cosines there, and where their shadow rays start and
go: strength and cosine (m,), origin (3, m), to_light and inverse_length as ``Sample`` has them."""


def _facing(hits: Hits, sample: Sample, shaded: Mask | None) -> _Facing | None:
    """The hits that face the light and are faced by it; None if there are none.

    Parameters
    ----------
    shaded : (1 or 2, M) which materials show light, from the back too where there are two rows; None for all
    """
    strength = dot(hits.ns, sample.to_light)
    strength *= sample.inverse_length
    cosine = strength
    strength = cosine * sample.factor
    if shaded is not None:
        sides = [row.take(hits.material) for row in shaded]
        strength *= sides[0] if len(sides) == 1 else np.where(hits.entering, *sides)
    which = np.flatnonzero(strength > 0)
    if len(which) == 0:
        return None
    origin, to_light, inverse_length = hits.above, sample.to_light, sample.inverse_length
    if len(which) < hits.size:
        strength, cosine = strength.take(which), cosine.take(which)
        origin = origin.take(which, axis=1)
        if to_light.shape[1] > 1:
            to_light = to_light.take(which, axis=1)
            inverse_length = inverse_length.take(which)
    return which, strength, cosine, origin, to_light, inverse_length


def _facing_by_loop(hits: Hits, sample: Sample, shaded: Mask | None) -> _Facing | None:
    """The same, to the same bits, in two loops."""
    from course.transport import direct_kernels

    n = hits.size
    which = np.empty(n, np.int64)
    strength, cosine = np.empty(n, np.float32), np.empty(n, np.float32)
    to_light, inverse_length = map(np.ascontiguousarray, (sample.to_light, sample.inverse_length))
    found = direct_kernels.facing(
        *map(np.ascontiguousarray, (hits.ns, hits.material, hits.side)),
        *(to_light, inverse_length, np.ascontiguousarray(sample.factor)),
        *(_ALL if shaded is None else shaded, which, strength, cosine),
    )
    if found == 0:
        return None
    origin = hits.above
    if found < n:
        which, strength, cosine = which[:found], strength[:found], cosine[:found]
        origin = np.empty((3, found), np.float32)
        there, near = np.empty((3, 0), np.float32), inverse_length[:0]
        if to_light.shape[1] > 1:
            there, near = np.empty((3, found), np.float32), np.empty(found, np.float32)
        direct_kernels.gather(
            which, np.ascontiguousarray(hits.above), to_light, inverse_length, origin, there, near
        )
        if to_light.shape[1] > 1:
            to_light, inverse_length = there, near
    return which, strength, cosine, origin, to_light, inverse_length


def _sees(
    world: World,
    light: Light,
    hits: Hits,
    which: Indices,
    cosine: Floats32,
    origin: Floats32,
    to_light: Floats32,
    counters: Counters,
) -> Mask:
    """Whether nothing stands between some of the hits and the light.

    Where a facet of a smooth mesh faces away from a light that its shading normal faces, the shadow ray starts from
    the round surface above the facet, provided that the way up there is free.

    Parameters
    ----------
    which : (m,) the hits
    cosine : (m,) between their shading normals and the way to the light
    origin, to_light : (3, m)
    """
    accelerator = world.surface.accelerator
    time = None if hits.time is None else hits.time.take(which)
    counters.rays["shadow"] += len(which)
    if to_light.shape[1] != len(which):
        to_light = np.repeat(to_light, len(which), axis=1)
    if world.surface.bulge is None:
        return accelerator.unoccluded(origin, to_light, light.limit, counters.embree, time)
    # The shading normal is within an angle of sine `bend` of the facet's: no other hits can face a light that their
    # facets turn away from.
    find = _turned_by_loop if hits.compiled else _turned
    turned = find(hits, which, cosine, to_light, np.float32(world.surface.bend + _ROUNDING))
    height = bulge(world.surface, hits, which.take(turned))
    raised = np.flatnonzero(height)
    if len(raised) == 0:
        return accelerator.unoccluded(origin, to_light, light.limit, counters.embree, time)
    turned = turned.take(raised)
    up = hits.ns.take(which.take(turned), axis=1) * height.take(raised)
    foot = origin.take(turned, axis=1)
    counters.rays["shadow"] += len(turned)
    way_up = accelerator.unoccluded(
        foot, up, 1.0, counters.embree, None if time is None else time.take(turned)
    )
    # Changed in place for the query and put back: only a few hits are raised, and copies of all would cost more.
    way = to_light.take(turned, axis=1)
    origin[:, turned] = foot + up
    if light.limit <= 1:
        to_light[:, turned] -= up
    free = accelerator.unoccluded(origin, to_light, light.limit, counters.embree, time)
    origin[:, turned] = foot
    to_light[:, turned] = way
    free[turned] &= way_up
    return free


def _turned(
    hits: Hits, which: Indices, cosine: Floats32, to_light: Floats32, most: np.float32
) -> Indices:
    """Which of some hits have facets that turn away from the light.

    Parameters
    ----------
    which, cosine, to_light : as ``_sees`` has them
    most : the cosine up to which that may be
    """
    near = np.flatnonzero(cosine <= most)
    ng = hits.ng.take(which.take(near), axis=1)
    return near[dot(ng, to_light.take(near, axis=1)) <= 0]


def _turned_by_loop(
    hits: Hits, which: Indices, cosine: Floats32, to_light: Floats32, most: np.float32
) -> Indices:
    """The same, in one loop."""
    from course.transport import direct_kernels

    turned = np.empty(len(which), np.int64)
    arrays = which, cosine, hits.ng, to_light
    return turned[: direct_kernels.turned(*map(np.ascontiguousarray, arrays), most, turned)]


def _highlight(
    hits: Hits, lookups: Lookups, which: Indices, to_light: Floats32, inverse_length: Floats32
) -> Floats32:
    """(n . h)^exponent at the chosen hits."""
    everything = len(which) == hits.size
    direction = hits.direction if everything else hits.direction.take(which, axis=1)
    normal = hits.ns if everything else hits.ns.take(which, axis=1)
    material = hits.material if everything else hits.material.take(which)
    half = to_light * inverse_length - direction
    squared = dot(half, half)
    cosine = dot(half, normal)
    cosine /= np.sqrt(np.maximum(squared, np.float32(1e-12)))
    # Powers by exponential and logarithm, which NumPy computes ten times faster than `power`; below the smallest
    # argument the power is nothing anyway, except for exponent 0, where it is 1 for every cosine.
    np.clip(cosine, np.float32(1e-6), 1, out=cosine)
    np.log(cosine, out=cosine)
    cosine *= lookups.exponent(material)
    return np.exp(cosine, out=cosine)


def _cosine(
    hits: Hits, which: Indices, to_light: Floats32, inverse_length: Floats32, wanted: Mask
) -> Floats32:
    """Cosine between the normal and the way to the light where it is wanted, 1 elsewhere."""
    cosine = dot(hits.ns.take(which, axis=1), to_light) * inverse_length
    return np.where(wanted, np.maximum(cosine, np.float32(1e-20)), np.float32(1))


def _accumulated(
    total: Floats32 | None, hits: Hits, which: Indices, values: Floats32, color: Floats32
) -> Floats32:
    """Add values of the chosen hits, times a colour, to (3, n) of all hits."""
    if hits.compiled:
        from course.transport import direct_kernels

        if total is None:
            total = np.zeros((3, hits.size), np.float32)
        direct_kernels.spread(which, *map(np.ascontiguousarray, (values, color)), total)
        return total
    if len(which) < hits.size:
        spread = np.zeros(hits.size, np.float32)
        spread[which] = values
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
