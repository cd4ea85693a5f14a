"""Direct light: for each light one point on it, one occlusion query, and Blinn-Phong reflection.

Symbols: l the vector to the light (not normalised), d its length, n the shading normal, v = -direction the way back
to the viewer, h the half vector between l and v.
"""

from __future__ import annotations

import numpy as np

from course.appearance.lights import Light
from course.core.types import Floats32, Indices
from course.core.vectors import dot
from course.geometry.hits import Hits
from course.scene.world import World
from course.transport.counters import Counters
from course.transport.paths import Draws
from course.transport.plan import Lookups, Plan


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
        lit = _irradiance(world, light, hits, u, draws.counters)
        if lit is None:
            continue
        which, irradiance, to_light, inverse_length = lit
        diffuse = _accumulated(diffuse, hits.size, which, irradiance, light.color)
        if plan.specular:
            highlight = _highlight(hits, lookups, which, to_light, inverse_length)
            highlight *= irradiance
            specular = _accumulated(specular, hits.size, which, highlight, light.color)
    if diffuse is None:
        return None
    diffuse *= lookups.diffuse(hits.material)
    if specular is not None:
        specular *= lookups.specular(hits.material)
        diffuse += specular
    return diffuse


def _irradiance(
    world: World, light: Light, hits: Hits, u: Floats32 | None, counters: Counters
) -> tuple[Indices, Floats32, Floats32, Floats32] | None:
    """Which hits the light reaches, its irradiance there, and the way to the light.

    Only hits that face the light, and that the light faces, cast a shadow ray.
    """
    sample = light.sample(hits.raised, u)
    strength = dot(hits.ns, sample.to_light)
    strength *= sample.inverse_length
    strength *= sample.factor
    which = np.flatnonzero(strength > 0)
    if len(which) == 0:
        return None
    origin, to_light, inverse_length = hits.raised, sample.to_light, sample.inverse_length
    if len(which) < hits.size:
        strength = strength.take(which)
        origin = origin.take(which, axis=1)
        if to_light.shape[1] > 1:
            to_light = to_light.take(which, axis=1)
            inverse_length = inverse_length.take(which)
    towards = to_light
    if towards.shape[1] != len(which):
        towards = np.repeat(towards, len(which), axis=1)
    free = world.surface.accelerator.unoccluded(origin, towards, light.limit, counters.embree)
    counters.rays["shadow"] += len(which)
    strength *= free
    return which, strength, to_light, inverse_length


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


def _accumulated(
    total: Floats32 | None, size: int, which: Indices, values: Floats32, color: Floats32
) -> Floats32:
    """Add values of the chosen hits, times a colour, to (3, size)."""
    if len(which) < size:
        spread = np.zeros(size, np.float32)
        spread[which] = values
        values = spread
    added: Floats32 = values * color[:, None]
    if total is None:
        return added
    total += added
    return total
