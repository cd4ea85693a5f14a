"""The ways that light takes from a surface that mirrors or refracts: how much takes each, and in which direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.appearance.fresnel import fresnel_and_cos_t, refract
from course.core.types import Floats32, Indices, Media
from course.core.vectors import dot
from course.geometry.hits import Hits
from course.geometry.leaving import kept_above, mirrored_above
from course.transport.gloss import Blur
from course.transport.paths import OPEN
from course.transport.plan import Lookups, Plan
from course.transport.rough_refraction import bend, scatter


@dataclass(frozen=True)
class Boundary:
    """The boundary of a dielectric at n hits; of no meaning where the material is opaque.

    Attributes
    ----------
    cos_i, cos_t : (n,) cosines of incidence and refraction
    eta : (n,) n_from / n_to
    bent : (3, n) directions refracted by rough glass, of no meaning at other hits; None where there are none
    """

    cos_i: Floats32
    cos_t: Floats32
    eta: Floats32
    bent: Floats32 | None

    def of(self, which: Indices) -> Boundary:
        """Some of the hits."""
        return Boundary(
            self.cos_i.take(which),
            self.cos_t.take(which),
            self.eta.take(which),
            None if self.bent is None else self.bent.take(which, axis=1),
        )


def reflectance(lookups: Lookups, hits: Hits, which: Indices | None) -> Floats32:
    """What some of the hits, or all of them, mirror, (3, n) or (3, 1); glass mirrors more (``divided``)."""
    material = hits.material if which is None else hits.material.take(which)
    mirror = lookups.mirror(material)
    if lookups.conductors is None:
        return mirror
    direction, ns = hits.direction, hits.ns
    if which is not None:
        direction, ns = direction.take(which, axis=1), ns.take(which, axis=1)
    return lookups.conductors.weakened(mirror, material, -dot(direction, ns))


def divided(
    plan: Plan, lookups: Lookups, hits: Hits, which: Indices | None, blur: Blur | None
) -> tuple[Floats32, Floats32, Boundary]:
    """How the boundary of a dielectric divides the light at some of the hits, or at all of them.

    Returns
    -------
    reflected, refracted : (n,) shares of the light, 0 where the material is opaque
    boundary : as ``refracted`` wants it
    """
    if hits.compiled and plan.refraction_dimension is None:
        return _divided_by_loop(lookups, hits, which)
    material, entering, direction, ns = hits.material, hits.entering, hits.direction, hits.ns
    if which is not None:
        material, entering = material.take(which), entering.take(which)
        direction, ns = direction.take(which, axis=1), ns.take(which, axis=1)
    index = lookups.refraction_index(material)
    glass = index > 0
    # Against what is outside: a ray that enters goes from 1 to the index, one that leaves from the index to 1.
    safe = np.where(glass, index, np.float32(1))
    eta = np.where(entering, 1 / safe, safe)
    cos_i = np.clip(-dot(direction, ns), 0, 1)
    share, cos_t = fresnel_and_cos_t(cos_i, eta)
    bent = None
    if plan.refraction_dimension is not None and blur is not None:
        ends = ~entering if blur.lets_out else None
        bent = bend(blur.lobes, material, direction, ns, cos_i, eta, ends, share)
    return share * glass, (1 - share) * glass, Boundary(cos_i, cos_t, eta, bent)


def _divided_by_loop(
    lookups: Lookups, hits: Hits, which: Indices | None
) -> tuple[Floats32, Floats32, Boundary]:
    """``divided`` to the same bits, where no glass is rough."""
    from course.transport import way_kernels

    if which is None:
        which = np.arange(hits.size)
    n = len(which)
    reflected, passed, cos_i, cos_t, eta = (np.empty(n, np.float32) for _ in range(5))
    arrays = hits.material, hits.side, hits.direction, hits.ns, lookups.refraction_index.rows
    way_kernels.divide(
        which, *map(np.ascontiguousarray, arrays), reflected, passed, cos_i, cos_t, eta
    )
    return reflected, passed, Boundary(cos_i, cos_t, eta, None)


def mirrored(
    plan: Plan, hits: Hits, which: Indices, ng: Floats32, path: Indices, blur: Blur | None
) -> Floats32:
    """Directions (3, m) in which some of the hits mirror, on the inside of rough glass that has no gloss jittered too.

    Parameters
    ----------
    ng : (3, m) geometric normals of those hits
    path : (m,) of those hits
    """
    way = mirrored_above(hits, which, ng, blur is not None and blur.keeps)
    if blur is None:
        return way
    material = hits.material.take(which)
    way = blur(material, way, ng, path)
    if plan.refraction_dimension is None:
        return way
    inside = np.flatnonzero(~hits.entering.take(which))
    back, away = way.take(inside, axis=1), -ng.take(inside, axis=1)
    scatter(plan, blur, material.take(inside), back, away, path.take(inside), back, glossy=False)
    way[:, inside] = back
    return way


def refracted(
    plan: Plan, hits: Hits, which: Indices, boundary: Boundary, path: Indices, blur: Blur | None
) -> Floats32:
    """Directions (3, m) in which some of the hits let light through.

    Parameters
    ----------
    boundary, path : of those hits
    """
    keeps = blur is not None and blur.keeps
    if hits.compiled and plan.refraction_dimension is None and not keeps:
        from course.transport import way_kernels

        way = np.empty((3, len(which)), np.float32)
        arrays = hits.direction, hits.ns, hits.ng, boundary.cos_i, boundary.cos_t, boundary.eta
        way_kernels.refract(which, *map(np.ascontiguousarray, arrays), way)
        return way
    direction, ns = hits.direction.take(which, axis=1), hits.ns.take(which, axis=1)
    ng = hits.ng.take(which, axis=1)
    way = refract(direction, ns, boundary.cos_i, boundary.cos_t, boundary.eta)
    if not keeps:
        way = kept_above(way, -ng)
    if boundary.bent is not None and blur is not None and plan.refraction_dimension is not None:
        scatter(plan, blur, hits.material.take(which), boundary.bent, ng, path, way)
    return way


def beyond(lookups: Lookups, hits: Hits, which: Indices) -> Media:
    """The medium (m,) behind some of the hits, for rays that go through."""
    material = hits.material.take(which).astype(np.int16)
    outside = OPEN if lookups.outside is None else lookups.outside.take(material)
    return np.where(hits.entering.take(which), material, outside)


def departures(
    hits: Hits, which: Indices, crossing: int, after: Floats32
) -> tuple[Floats32, Floats32]:
    """Where the rays that leave some of the hits start, and their throughput, (3, m) each.

    Parameters
    ----------
    which : (m,) the hits
    crossing : from which of them on rays leave on the far side
    after : (3, n) throughput after all hits
    """
    if hits.compiled:
        from course.transport import way_kernels

        origin, throughput = np.empty((2, 3, len(which)), np.float32)
        arrays = hits.above, hits.p, hits.ng, hits.offset, after
        way_kernels.leave(which, crossing, *map(np.ascontiguousarray, arrays), origin, throughput)
        return origin, throughput
    origin = hits.above.take(which[:crossing], axis=1)
    if crossing < len(which):
        origin = np.concatenate((origin, hits.below(which[crossing:])), axis=1)
    return origin, after.take(which, axis=1)
