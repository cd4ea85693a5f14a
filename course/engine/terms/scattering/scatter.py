"""Scattering by metals, rough glass and microfacets, and without correcting directions that point into the surface."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.fresnel_refraction import refract
from course.engine.core.hits import Hits
from course.engine.core.rays import Draws
from course.engine.core.scatter import Boundary, Scatter, kept_above
from course.engine.core.types import Floats32, Indices
from course.engine.core.vectors import dot, reflect
from course.engine.terms.scattering import microfacets, rough_glass
from course.engine.terms.scattering.conductors import Conductors
from course.engine.terms.scattering.microfacets import Microfacets
from course.engine.terms.scattering.rough_glass import RoughGlass
from course.engine.terms.surfaces.hits_on import hits_on


@dataclass(frozen=True)
class RoughBoundary(Boundary):
    """``rough_direction`` (3, n) float32: directions refracted by rough glass, undefined at other hits."""

    rough_direction: Floats32


@dataclass(frozen=True)
class FullScatter(Scatter):
    """Casts reflected and refracted rays.

    Attributes
    ----------
    conductors : the smooth metals; None if there are none
    rough : the rough glasses
    microfacets : the metals and glasses whose microfacets are drawn
    keeps : true if directions that point into the surface are kept
    max_depth : largest number of bounces
    """

    conductors: Conductors | None = None
    rough: tuple[RoughGlass, ...] = ()
    keeps: bool = False
    max_depth: int = 0
    microfacets: tuple[Microfacets, ...] = ()

    def reflectance(self, hits: Hits, which: Indices | None) -> Floats32:
        """See ``Scatter``."""
        mirror = super().reflectance(hits, which)
        if self.conductors is None:
            return mirror
        material, direction, ns = hits.material, hits.direction, hits.ns
        if which is not None:
            material = material.take(which)
            direction, ns = direction.take(which, axis=1), ns.take(which, axis=1)
        return self.conductors.weakened(mirror, material, -dot(direction, ns))

    def boundary(
        self,
        hits: Hits,
        which: Indices | None,
        path: Indices | None,
        depth: int,
        draws: Draws,
    ) -> Boundary:
        """See ``Scatter``."""
        smooth = super().boundary(hits, which, path, depth, draws)
        if self.index is None or not (self.rough or self.microfacets):
            return smooth
        which = np.arange(hits.size) if which is None else which
        path = which if path is None else path
        material, entering = hits.material.take(which), hits.entering.take(which)
        direction, ns = hits.direction.take(which, axis=1), hits.ns.take(which, axis=1)
        # If directions are kept, another renderer is reproduced, which loses that light.
        ends = ~entering if depth + 1 == self.max_depth and not self.keeps else None
        share = smooth.reflected
        cos_i, cos_t, eta = smooth.cos_i, smooth.cos_t, smooth.eta
        bent = rough_glass.bend(self.rough, material, direction, ns, cos_i, eta, ends, share)
        facets = self.microfacets
        bent = microfacets.bend(facets, hits, which, path, depth, draws, eta, share, bent)
        glass = self.index(material) > 0
        arrays = share * glass, (1 - share) * glass, cos_i, cos_t, eta
        return Boundary(*arrays) if bent is None else RoughBoundary(*arrays, bent)

    def mirrored(
        self, hits: Hits, which: Indices, path: Indices, depth: int, draws: Draws
    ) -> Floats32:
        """See ``Scatter``; inside rough glass without gloss, directions are jittered, too."""
        way = super().mirrored(hits, which, path, depth, draws)
        microfacets.scatter(self.microfacets, hits, which, path, depth, draws, way)
        if not self.rough:
            return way
        material, ng = hits.material.take(which), hits.ng.take(which, axis=1)
        inside = np.flatnonzero(~hits.entering.take(which))
        back, away = way.take(inside, axis=1), -ng.take(inside, axis=1)
        arrays = material.take(inside), back, away, path.take(inside)
        rough_glass.scatter(
            self.rough, self.keeps, *arrays, depth, draws, direction=back, glossy=False
        )
        way[:, inside] = back
        return way

    def mirror_images(self, hits: Hits, which: Indices, ng: Floats32) -> Floats32:
        """See ``Scatter``."""
        if not self.keeps:
            return super().mirror_images(hits, which, ng)
        return reflect(hits.direction.take(which, axis=1), hits.ns.take(which, axis=1))

    def refracted(
        self,
        hits: Hits,
        which: Indices,
        boundary: Boundary,
        path: Indices,
        depth: int,
        draws: Draws,
    ) -> Floats32:
        """See ``Scatter``."""
        if not (self.keeps or self.rough or self.microfacets):
            return super().refracted(hits, which, boundary, path, depth, draws)
        direction, ns = hits.direction.take(which, axis=1), hits.ns.take(which, axis=1)
        ng = hits.ng.take(which, axis=1)
        way = refract(direction, ns, boundary.cos_i, boundary.cos_t, boundary.eta)
        if not self.keeps:
            way = kept_above(way, -ng)
        if isinstance(boundary, RoughBoundary):
            material = hits.material.take(which)
            for one, some in hits_on(self.microfacets, material):
                if one.k is None:
                    way[:, some] = boundary.rough_direction.take(some, axis=1)
            arrays = material, boundary.rough_direction, ng, path
            rough_glass.scatter(self.rough, self.keeps, *arrays, depth, draws, direction=way)
        return way

    def weights(self, hits: Hits, which: Indices, way: Floats32, through: bool) -> Floats32 | None:
        """See ``Scatter``, and ``course.engine.terms.scattering.microfacets``."""
        return microfacets.weights(self.microfacets, hits, which, way, through)
