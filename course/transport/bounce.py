"""Rays that go on: mirrored and refracted, with what they will contribute, as long as that can be seen."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Indices, Media
from course.geometry.hits import Hits
from course.transport.gloss import Blur
from course.transport.paths import OPEN, Rays
from course.transport.plan import Lookups, Plan
from course.transport.ways import (
    Boundary,
    beyond,
    departures,
    divided,
    mirrored,
    reflectance,
    refracted,
)


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
    mirror = reflectance(lookups, hits, None)
    if not plan.refracts:
        weight = _weight(mirror, throughput)
        return _reflected(plan, hits, weight, path, medium, cutoff, blur), None
    share, passed, boundary = divided(plan, lookups, hits, None, blur)
    weight = _weight(mirror + share, throughput)
    reflected = _reflected(plan, hits, weight, path, medium, cutoff, blur)
    weight = _weight(passed, throughput)
    return reflected, _refracted(plan, lookups, hits, weight, boundary, path, medium, cutoff, blur)


def _weight(factor: Floats32, throughput: Floats32 | None) -> Floats32:
    return factor if throughput is None else factor * throughput


def _visible(weight: Floats32, size: int, cutoff: float) -> Indices:
    """Which columns of (3, size), (3, 1) or (size,) are worth a ray."""
    largest = weight.max(axis=0) if weight.ndim == 2 else weight
    if len(largest) < size:
        return np.arange(size if largest[0] > cutoff else 0)
    return np.flatnonzero(largest > cutoff)


def _departures(
    hits: Hits, which: Indices, crossing: int, weight: Floats32
) -> tuple[Floats32, Floats32]:
    """As ``departures``, of weights (3, n), (3, 1) or (n,)."""
    if weight.ndim == 2 and weight.shape[1] == hits.size:
        return departures(hits, which, crossing, weight)
    origin = hits.above.take(which, axis=1) if crossing else hits.below(which)
    if weight.ndim == 1:
        return origin, np.repeat(weight.take(which)[None], 3, axis=0)
    return origin, np.repeat(weight, len(which), axis=1)


def _reflected(
    plan: Plan,
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
    ng = hits.ng.take(which, axis=1)
    origin, rest = _departures(hits, which, len(which), weight)
    direction = mirrored(plan, hits, which, ng, path, blur)
    return Rays(
        origin,
        direction,
        rest,
        path,
        None if medium is None else medium.take(which),
        None if hits.time is None else hits.time.take(which),
        hits.leaving(which, direction),
        None if medium is None else hits.p.take(which, axis=1),
    )


def _refracted(
    plan: Plan,
    lookups: Lookups,
    hits: Hits,
    weight: Floats32,
    boundary: Boundary,
    path: Indices | None,
    medium: Media | None,
    cutoff: float,
    blur: Blur | None,
) -> Rays | None:
    which = _visible(weight, hits.size, cutoff)
    if len(which) == 0:
        return None
    path = which if path is None else path.take(which)
    origin, rest = _departures(hits, which, 0, weight)
    direction = refracted(plan, hits, which, boundary.of(which), path, blur)
    return Rays(
        origin,
        direction,
        rest,
        path,
        None if medium is None else beyond(lookups, hits, which),
        None if hits.time is None else hits.time.take(which),
        hits.leaving(which, direction),
        None if medium is None else hits.p.take(which, axis=1),
    )
