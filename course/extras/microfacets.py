"""Rough metals and rough glass: rays meet microfacets, which the functions of the `microfacets` module draw.

Directions are drawn first, and what each of them counts follows from it. With visible normals that is F G2 / G1 of
reflected rays, at most 1, and (1 - F) G1 of refracted ones, whose shadowing is taken for independent of the masking
(Walter et al., 2007). Directions that end up on the wrong side of the surface count 0.

Whether a path is mirrored or refracted is decided before a microfacet is drawn, by the reflectance of the smooth
surface. What its microfacet reflects is divided by that probability.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.fresnel_refraction import refract
from course.core.hits import Hits
from course.core.rays import Draws
from course.core.scatter import Boundary
from course.core.types import Floats32, Floats64, Functions, Indices, Mask, Materials
from course.core.vectors import dot, reflect
from course.extras.hemisphere import turned
from course.extras.hits_on import hits_on

NUMBERS = ("microfacet", 2)
"""Name and width of the numbers that one microfacet takes."""

LEAST_CHANCE = np.float32(0.05)
"""Of reflection and of refraction at rough glass: a microfacet may do what the smooth surface doesn't."""

FLATTEST = np.float32(1e-6)
"""The least cosine that the functions are asked for."""


@dataclass(frozen=True)
class Microfacets:
    """One rough metal or rough glass.

    Attributes
    ----------
    material : its number
    alpha : its roughness, 0.001 to 1
    n, k : (3,) index of refraction against the medium outside; k is None for glass
    functions : of the module microfacets
    """

    material: int
    alpha: float
    n: Floats64
    k: Floats64 | None
    functions: Functions

    def normals(self, direction: Floats32, ns: Floats32, u: Floats32) -> Floats32:
        """Microfacets (3, n) that rays (3, n) meet, about the normals (3, n)."""
        one, none = np.ones_like(u[0]), np.zeros_like(u[0])
        frame = turned(ns, one, none, none), turned(ns, none, one, none), ns
        wo = np.stack([-dot(axis, direction) for axis in frame])
        np.maximum(wo[2], FLATTEST, out=wo[2])
        return turned(ns, *self.functions.sample_visible_normal(wo, self.alpha, u))

    def reflectance(self, cos: Floats32, entering: Mask) -> Floats32:
        """Fresnel reflectance (3, n) of microfacets; of glass from either side."""
        if self.k is not None:
            metal: Floats32 = self.functions.fresnel_complex(cos, self.n, self.k)
            return metal
        clear = np.zeros(3)
        outside = self.functions.fresnel_complex(cos, self.n, clear)
        inside = self.functions.fresnel_complex(cos, 1 / self.n, clear)
        share: Floats32 = np.where(entering, outside, inside)
        return share


def chances(rough: tuple[Microfacets, ...], material: Materials, smooth: Boundary) -> None:
    """Leave reflection and refraction at rough glass a chance each, written into the boundary (n,)."""
    for one, which in hits_on(rough, material):
        if one.k is None:
            chance = np.clip(smooth.reflected.take(which), LEAST_CHANCE, 1 - LEAST_CHANCE)
            smooth.reflected[which], smooth.refracted[which] = chance, 1 - chance


def scatter(
    rough: tuple[Microfacets, ...],
    hits: Hits,
    which: Indices,
    path: Indices,
    depth: int,
    draws: Draws,
    way: Floats32,
    eta: Floats32 | None = None,
) -> None:
    """Write the directions that microfacets mirror, or refract where ``eta`` (m,) is given, into ``way`` (3, m)."""
    for one, some in hits_on(rough, hits.material.take(which)):
        if eta is not None and one.k is not None:
            continue
        chosen = which.take(some)
        direction = hits.direction.take(chosen, axis=1)
        u = draws(NUMBERS[0], path.take(some), depth)
        wm = one.normals(direction, hits.ns.take(chosen, axis=1), u)
        way[:, some] = (
            reflect(direction, wm) if eta is None else _refract(direction, wm, eta.take(some))
        )


def _refract(direction: Floats32, wm: Floats32, eta: Floats32) -> Floats32:
    """Refracted directions (3, n); the way back, which counts 0, where reflection is total."""
    cos_i = -dot(direction, wm)
    squared = 1 - eta * eta * (1 - cos_i) * (1 + cos_i)
    bent = refract(direction, wm, cos_i, np.sqrt(np.maximum(squared, 0)), eta)
    result: Floats32 = np.where(squared > 0, bent, -direction)
    return result


def weights(
    rough: tuple[Microfacets, ...],
    hits: Hits,
    which: Indices,
    way: Floats32,
    smooth: Callable[[Indices], Boundary],
    through: bool,
) -> Floats32 | None:
    """What the directions (3, m) count in which rays leave the hits (m,), (3, m); None where no hit is rough.

    Parameters
    ----------
    smooth : the boundary of hits on rough glass, with its chances
    through : whether the rays are refracted
    """
    count = None
    for one, some in hits_on(rough, hits.material.take(which)):
        if through and one.k is not None:
            continue
        if count is None:
            count = np.ones((3, len(which)), np.float32)
        chosen = which.take(some)
        direction, ns, ng = (v.take(chosen, axis=1) for v in (hits.direction, hits.ns, hits.ng))
        w = way.take(some, axis=1)
        side = np.float32(-1 if through else 1)
        cos_o, cos_i = np.maximum(-dot(direction, ns), FLATTEST), side * dot(w, ns)
        share: Floats32 | np.float32 = np.float32(1)
        wm = w - direction
        if one.k is None:
            boundary = smooth(chosen)
            share = boundary.refracted if through else boundary.reflected
            if through:
                wm = direction * boundary.eta - w
        cos = np.abs(dot(wm, direction)) / np.sqrt(np.maximum(dot(wm, wm), np.float32(1e-20)))
        reflected = one.reflectance(cos.astype(np.float32), hits.entering.take(chosen))
        g1, g2 = one.functions.smith_g1, one.functions.smith_g2
        if through:
            found = (1 - reflected) * g1(cos_i, one.alpha)
        else:
            found = reflected * (g2(cos_o, cos_i, one.alpha) / g1(cos_o, one.alpha))
        count[:, some] = found / share * ((cos_i > 0) & (side * dot(w, ng) > 0))
    return count
