"""Rays that go on: mirrored and refracted, with what they will contribute, as long as that can be seen."""

from __future__ import annotations

import numpy as np

from course.appearance.fresnel import fresnel_and_cos_t, refract
from course.core.types import Floats32, Indices, Media
from course.core.vectors import dot, reflect
from course.geometry.hits import Hits
from course.transport.gloss import Blur
from course.transport.paths import OPEN, Rays
from course.transport.plan import Lookups, Plan
from course.transport.rough_refraction import bend, scatter


def bounced(
    plan: Plan,
    lookups: Lookups,
    hits: Hits,
    throughput: Floats32 | None,
    path: Indices | None,
    medium: Media | None,
    cutoff: float,
    blur: Blur | None = None,
) -> tuple[Rays | None, Rays | None]:
    """Reflected and refracted rays of the hits; None where there are none.

    Parameters
    ----------
    throughput : (3, n) float32 of the rays that hit, or None for 1
    path : (n,) or None for all paths in order
    blur : jitters the mirrored directions of glossy materials, and has the lobes of rough glass; None where there are
        none
    medium : (n,) the material that the arriving ray travelled in, or None where nothing absorbs
    """
    if plan.absorbs and medium is None:
        medium = np.full(hits.size, OPEN)
    reflectance = lookups.mirror(hits.material)
    if lookups.conductors is not None:
        cosine = -dot(hits.direction, hits.ns)
        reflectance = lookups.conductors.weakened(reflectance, hits.material, cosine)
    transmitted = None
    if plan.refracts:
        index = lookups.refraction_index(hits.material)
        glass = index > 0
        # Outside is vacuum: a ray that enters goes from 1 to the index, one that leaves from the index to 1.
        safe = np.where(glass, index, np.float32(1))
        eta = np.where(hits.entering, 1 / safe, safe)
        cos_i = np.clip(-dot(hits.direction, hits.ns), 0, 1)
        share, cos_t = fresnel_and_cos_t(cos_i, eta)
        share *= glass
        bent = None
        if plan.refraction_dimension is not None and blur is not None:
            bent = bend(blur.lobes, hits.material, hits.direction, hits.ns, cos_i, eta, share)
        reflectance = reflectance + share
        transmitted = _weight((1 - share) * glass, throughput)
    weight = _weight(reflectance, throughput)
    reflected = _reflected(hits, weight, path, medium, cutoff, blur)
    if transmitted is None:
        return reflected, None
    refracted = _refracted(
        hits, transmitted, cos_i, cos_t, eta, path, medium, cutoff, plan, blur, bent
    )
    return reflected, refracted


def _weight(factor: Floats32, throughput: Floats32 | None) -> Floats32:
    return factor if throughput is None else factor * throughput


def _visible(weight: Floats32, size: int, cutoff: float) -> Indices:
    """Which columns of (3, size), (3, 1) or (size,) are worth a ray."""
    largest = weight.max(axis=0) if weight.ndim == 2 else weight
    if len(largest) < size:
        return np.arange(size if largest[0] > cutoff else 0)
    return np.flatnonzero(largest > cutoff)


def _columns(weight: Floats32, which: Indices) -> Floats32:
    """(3, n) throughputs of the chosen columns."""
    if weight.ndim == 1:
        return np.repeat(weight.take(which)[None], 3, axis=0)
    if weight.shape[1] == 1:
        return np.repeat(weight, len(which), axis=1)
    return weight.take(which, axis=1)


def _reflected(
    hits: Hits,
    weight: Floats32,
    path: Indices | None,
    medium: Media | None,
    cutoff: float,
    blur: Blur | None,
) -> Rays | None:
    which = _visible(weight, hits.size, cutoff)
    if len(which) == 0:
        return None
    path = which if path is None else path.take(which)
    mirrored = reflect(hits.direction.take(which, axis=1), hits.ns.take(which, axis=1))
    ng = hits.ng.take(which, axis=1)
    # An interpolated normal may mirror a ray into the surface; mirror it out again.
    below = np.minimum(dot(mirrored, ng), 0)
    if below.any():
        below += below
        mirrored -= below * ng
    if blur is not None:
        mirrored = blur(hits.material.take(which), mirrored, ng, path)
    return Rays(
        hits.above.take(which, axis=1),
        mirrored,
        _columns(weight, which),
        path,
        None if medium is None else medium.take(which),
        None if hits.time is None else hits.time.take(which),
    )


def _refracted(
    hits: Hits,
    weight: Floats32,
    cos_i: Floats32,
    cos_t: Floats32,
    eta: Floats32,
    path: Indices | None,
    medium: Media | None,
    cutoff: float,
    plan: Plan,
    blur: Blur | None,
    bent: Floats32 | None,
) -> Rays | None:
    which = _visible(weight, hits.size, cutoff)
    if len(which) == 0:
        return None
    path = which if path is None else path.take(which)
    direction = refract(
        hits.direction.take(which, axis=1),
        hits.ns.take(which, axis=1),
        cos_i.take(which),
        cos_t.take(which),
        eta.take(which),
    )
    ng = hits.ng.take(which, axis=1)
    # ... and it may refract a ray back to where it came from; the same cure, to the far side.
    above = np.maximum(dot(direction, ng), 0)
    if above.any():
        above += above
        direction -= above * ng
    if bent is not None and blur is not None and plan.refraction_dimension is not None:
        # As far into this depth's dimensions as the gloss is.
        dimension = plan.refraction_dimension + blur.dimension - plan.gloss_dimension
        material = hits.material.take(which)
        scatter(blur, dimension, material, bent.take(which, axis=1), ng, path, direction)
    inside = None
    if medium is not None:
        within = hits.material.take(which).astype(np.int16)
        inside = np.where(hits.entering.take(which), within, OPEN)
    return Rays(
        hits.below.take(which, axis=1),
        direction,
        _columns(weight, which),
        path,
        inside,
        None if hits.time is None else hits.time.take(which),
    )
