"""Rough metals and rough glass: rays meet microfacets, which the functions of the `microfacets` module draw.

Directions are drawn first, and what each of them counts follows from it. With visible normals that is F G2 / G1 of
reflected rays, at most 1, and (1 - F) G1 of refracted ones, whose shadowing is taken for independent of the masking
(Walter et al., 2007). Directions that end up on the wrong side of the surface count 0.

How much rough glass reflects is what the drawn microfacet reflects, and not the smooth surface: a microfacet may
reflect everything where the smooth surface is clear. A path that is mirrored with the probability of the smooth surface
would then carry many times the light of the others.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.engine.core.fresnel_refraction import refract
from course.engine.core.hits import Hits
from course.engine.core.rays import Draws
from course.engine.core.types import Floats, Floats32, Floats64, Functions, Indices, Mask
from course.engine.core.vectors import dot, reflect
from course.engine.terms.scattering.hemisphere import turned
from course.engine.terms.surfaces.hits_on import hits_on

NUMBERS = ("microfacet", 2)
"""Name and width of the numbers that one microfacet takes."""

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

    def met(
        self, hits: Hits, which: Indices, path: Indices, depth: int, draws: Draws
    ) -> tuple[Floats32, Floats32]:
        """Directions (3, n) of the rays of the hits (n,), and the microfacets (3, n) that they meet."""
        direction, ns = hits.direction.take(which, axis=1), hits.ns.take(which, axis=1)
        u = draws(NUMBERS[0], path, depth)
        (wo,) = _upright(ns, -direction)
        np.maximum(wo[2], FLATTEST, out=wo[2])
        return direction, turned(ns, *self.functions.sample_visible_normal(wo, self.alpha, u))

    def density(self, direction: Floats, ns: Floats, way: Floats) -> Floats32:
        """How dense the directions (n,) are [1/sr] that a metal's microfacets mirror rays to.

        Parameters
        ----------
        direction : (3, n) of the rays
        ns : (3, n) shading normals
        way : (3, n) unit vectors
        """
        # At a small roughness the last digits of the normals decide.
        direction, ns, way = (_unit(vectors) for vectors in (direction, ns, way))
        wm = way - direction
        wm /= np.sqrt(np.maximum(dot(wm, wm), 1e-20))
        cosine = -dot(wm, direction)
        wo, wm = _upright(ns, -direction, wm)
        np.maximum(wo[2], FLATTEST, out=wo[2])
        dense = self.functions.visible_normal_pdf(wo, wm, self.alpha)
        found: Floats32 = np.where(cosine > 0, dense / (4 * np.maximum(cosine, 1e-30)), 0)
        return found.astype(np.float32)

    def brdf(self, direction: Floats, ns: Floats, way: Floats) -> Floats32:
        """A metal's BRDF (3, n) [1/sr]; arrays as in ``density``."""
        direction, ns, way = (_unit(vectors) for vectors in (direction, ns, way))
        vectors = _upright(ns, -direction, way)
        found: Floats32 = self.functions.brdf(*vectors, self.alpha, self.n, self.k)
        return found.astype(np.float32)

    @property
    def peak(self) -> float:
        """About how dense the directions are in the middle [1/sr]."""
        return 1 / (4 * np.pi * self.alpha**2)

    def reflectance(self, cos: Floats32) -> Floats32:
        """Fresnel reflectance (3, n) of a metal's microfacets."""
        share: Floats32 = self.functions.fresnel_complex(cos, self.n, self.k)
        return share

    def share(self, cos: Floats32, entering: Mask) -> Floats32:
        """Fresnel reflectance (n,) of glass's microfacets, from either side."""
        reflectance, clear = self.functions.fresnel_complex, np.zeros(3)
        outside, inside = reflectance(cos, self.n, clear)[0], reflectance(cos, 1 / self.n, clear)[0]
        share: Floats32 = np.clip(np.where(entering, outside, inside), 0, 1)
        return share


def _unit(vectors: Floats) -> Floats64:
    """Vectors (3, n) in float64: halfway between grazing directions that aren't as long lies nothing upright."""
    exact = vectors.astype(np.float64)
    exact /= np.sqrt(dot(exact, exact))
    return exact


def _upright(ns: Floats, *vectors: Floats) -> list[Any]:
    """Vectors, (3, n) each, in frames whose third axes are the normals (3, n)."""
    one, none = np.ones_like(ns[0]), np.zeros_like(ns[0])
    frame = turned(ns, one, none, none), turned(ns, none, one, none), ns
    return [np.stack([dot(axis, each) for axis in frame]) for each in vectors]


def bend(
    rough: tuple[Microfacets, ...],
    hits: Hits,
    which: Indices,
    path: Indices,
    depth: int,
    draws: Draws,
    eta: Floats32,
    share: Floats32,
    bent: Floats32 | None,
) -> Floats32 | None:
    """Directions (3, m) refracted by the microfacets of rough glass, written into ``bent``; None where there are none.

    Parameters
    ----------
    which, path : (m,) the hits, and the paths that they belong to
    eta : (m,)
    share : (m,) of the light that is reflected; what the microfacets reflect is written into it
    bent : (3, m) what other glass refracts; None where it is nothing
    """
    for one, some in hits_on(rough, hits.material.take(which)):
        if one.k is not None:
            continue
        if bent is None:
            bent = np.zeros((3, len(which)), np.float32)
        chosen = which.take(some)
        direction, wm = one.met(hits, chosen, path.take(some), depth, draws)
        cos = np.clip(-dot(direction, wm), 0, 1)
        share[some] = one.share(cos, hits.entering.take(chosen))
        bent[:, some] = _refract(direction, wm, eta.take(some))
    return bent


def scatter(
    rough: tuple[Microfacets, ...],
    hits: Hits,
    which: Indices,
    path: Indices,
    depth: int,
    draws: Draws,
    way: Floats32,
) -> None:
    """Write the directions that microfacets mirror into ``way`` (3, m)."""
    for one, some in hits_on(rough, hits.material.take(which)):
        way[:, some] = reflect(*one.met(hits, which.take(some), path.take(some), depth, draws))


def _refract(direction: Floats32, wm: Floats32, eta: Floats32) -> Floats32:
    """Refracted directions (3, n); the way back, which counts 0, where reflection is total."""
    cos_i = -dot(direction, wm)
    squared = 1 - eta * eta * (1 - cos_i) * (1 + cos_i)
    bent = refract(direction, wm, cos_i, np.sqrt(np.maximum(squared, 0)), eta)
    result: Floats32 = np.where(squared > 0, bent, -direction)
    return result


def weights(
    rough: tuple[Microfacets, ...], hits: Hits, which: Indices, way: Floats32, through: bool
) -> Floats32 | None:
    """What the directions (3, m) count in which rays leave the hits (m,), (3, m); None where no hit is rough.

    ``through``: whether the rays are refracted. What rough glass reflects is in their throughput already.
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
        g1, g2 = one.functions.smith_g1, one.functions.smith_g2
        found = (
            g1(cos_i, one.alpha) if through else g2(cos_o, cos_i, one.alpha) / g1(cos_o, one.alpha)
        )
        if one.k is not None:
            wm = w - direction
            cos = np.abs(dot(wm, direction)) / np.sqrt(np.maximum(dot(wm, wm), np.float32(1e-20)))
            found = one.reflectance(cos.astype(np.float32)) * found
        count[:, some] = found * ((cos_i > 0) & (side * dot(w, ng) > 0))
    return count
