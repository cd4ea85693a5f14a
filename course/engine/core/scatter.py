"""Reflected and refracted rays: mirrors, gloss and dielectrics, as long as the throughput is above a cutoff."""

from dataclasses import dataclass, fields

import numpy as np

from course.engine.core.fresnel_refraction import fresnel_and_cos_t, refract
from course.engine.core.gloss import Gloss
from course.engine.core.hits import Hits, Surface
from course.engine.core.materials import Lookup
from course.engine.core.rays import OPEN, Draws, Rays, join_rays
from course.engine.core.types import Floats32, Indices, Media
from course.engine.core.vectors import dot, reflect, repeated


@dataclass(frozen=True)
class Boundary:
    """The boundary of a dielectric at n hits.

    Attributes
    ----------
    reflected, refracted : (n,) Fresnel reflectance and transmittance, 0 for opaque materials
    cos_i, cos_t, eta : (n,), see ``course.engine.core.fresnel_refraction``
    """

    reflected: Floats32
    refracted: Floats32
    cos_i: Floats32
    cos_t: Floats32
    eta: Floats32

    def of(self, which: Indices) -> "Boundary":
        """The boundary at some of the hits."""
        return type(self)(
            *(getattr(self, field.name).take(which, axis=-1) for field in fields(self))
        )


@dataclass(frozen=True)
class Scatter:
    """Casts reflected and refracted rays.

    Attributes
    ----------
    mirror : (3, M) mirror reflectance, to which a dielectric's Fresnel reflectance is added
    index : (M,) refraction index, 0 for opaque materials; None if all are opaque
    gloss : jitters mirrored directions; None if nothing is glossy
    absorbs : true if a dielectric absorbs, so that rays carry their medium
    outside : ``MaterialTable.outside``
    cutoff : rays are dropped unless their largest throughput channel is above this
    """

    surface: Surface
    mirror: Lookup
    index: Lookup | None
    gloss: Gloss | None
    absorbs: bool
    outside: Media | None
    cutoff: float

    def __call__(
        self,
        hits: Hits,
        throughput: Floats32 | None,
        path: Indices | None,
        medium: Media | None,
        depth: int,
        draws: Draws,
    ) -> Rays | None:
        """Rays of the next depth, or None. The incoming rays have the given throughput, path and medium (``Rays``)."""
        if self.absorbs and medium is None:
            medium = np.full(hits.size, OPEN)
        weight = repeated(self.reflectance(hits, None), hits.size)
        if self.index is None:
            weight = weight if throughput is None else weight * throughput
            return self._leaving(hits, weight, None, path, medium, depth, draws)
        boundary = self.boundary(hits, None, path, depth, draws)
        weight = weight + boundary.reflected
        # Refraction also scales radiance by (n_from / n_to)^2. We leave it out: it cancels once a ray is outside again.
        through = np.repeat(boundary.refracted[None], 3, axis=0)
        if throughput is not None:
            weight, through = weight * throughput, through * throughput
        # A way that is too weak to be followed gives its light to the other one: it would be missing.
        most = weight.max(axis=0), through.max(axis=0)
        parted, both = np.minimum(*most) > self.cutoff, weight + through
        weight = np.where(parted, weight, both * (most[0] >= most[1]))
        through = np.where(parted, through, both * (most[0] < most[1]))
        reflected = self._leaving(hits, weight, None, path, medium, depth, draws)
        refracted = self._leaving(hits, through, boundary, path, medium, depth, draws)
        if reflected is None or refracted is None:
            return reflected or refracted
        return join_rays([reflected, refracted])

    def reflectance(self, hits: Hits, which: Indices | None) -> Floats32:
        """Mirror reflectance (3, m) or (3, 1) at the given hits (None: all), without Fresnel reflectance."""
        return self.mirror(hits.material if which is None else hits.material.take(which))

    def boundary(
        self, hits: Hits, which: Indices | None, path: Indices | None, depth: int, draws: Draws
    ) -> Boundary:
        """Fresnel reflectance and refraction at hits (None: all). A subclass draws numbers for paths (m,)."""
        assert self.index is not None
        material, entering, direction, ns = hits.material, hits.entering, hits.direction, hits.ns
        if which is not None:
            material, entering = material.take(which), entering.take(which)
            direction, ns = direction.take(which, axis=1), ns.take(which, axis=1)
        index = self.index(material)
        glass = index > 0
        safe = np.where(glass, index, np.float32(1))
        eta = np.where(entering, 1 / safe, safe)
        cos_i = np.clip(-dot(direction, ns), 0, 1)
        share, cos_t = fresnel_and_cos_t(cos_i, eta)
        return Boundary(share * glass, (1 - share) * glass, cos_i, cos_t, eta)

    def mirrored(
        self, hits: Hits, which: Indices, path: Indices, depth: int, draws: Draws
    ) -> Floats32:
        """Reflected directions (3, m) at the given hits, above the surface; path: (m,)."""
        ng = hits.ng.take(which, axis=1)
        mirrored = self.mirror_images(hits, which, ng)
        if self.gloss is None:
            return mirrored
        return self.gloss(hits.material.take(which), mirrored, ng, path, depth, draws)

    def mirror_images(self, hits: Hits, which: Indices, ng: Floats32) -> Floats32:
        """Mirrored directions (3, m) at the given hits, whose geometric normals are ng (3, m)."""
        mirrored = reflect(hits.direction.take(which, axis=1), hits.ns.take(which, axis=1))
        return kept_above(mirrored, ng)

    def refracted(
        self,
        hits: Hits,
        which: Indices,
        boundary: Boundary,
        path: Indices,
        depth: int,
        draws: Draws,
    ) -> Floats32:
        """Refracted directions (3, m) at the given hits, whose boundary and paths (m,) are given."""
        direction, ns = hits.direction.take(which, axis=1), hits.ns.take(which, axis=1)
        refracted = refract(direction, ns, boundary.cos_i, boundary.cos_t, boundary.eta)
        return kept_above(refracted, -hits.ng.take(which, axis=1))

    def weights(self, hits: Hits, which: Indices, way: Floats32, through: bool) -> Floats32 | None:
        """What directions (3, m) off the given hits, or through their surface, count besides their throughput.

        (m,) float32, or None for 1: here directions are as dense as they are worth.
        """
        return None

    def medium_behind(self, hits: Hits, which: Indices) -> Media:
        """Medium (m,) of rays refracted at the given hits."""
        material = hits.material.take(which).astype(np.int16)
        outside = OPEN if self.outside is None else self.outside.take(material)
        return np.where(hits.entering.take(which), material, outside)

    def origins(
        self, hits: Hits, which: Indices, near: int, after: Floats32
    ) -> tuple[Floats32, Floats32]:
        """Origins and throughput, (3, m) each, of rays that leave hits ``which`` (m,).

        The first ``near`` of these rays leave on the incoming side, the others on the far side. ``after`` (3, n) has
        the throughput of all hits after the bounce.
        """
        origin = hits.near_origin.take(which[:near], axis=1)
        if near < len(which):
            origin = np.concatenate((origin, hits.far_origin(which[near:])), axis=1)
        return origin, after.take(which, axis=1)

    def _leaving(
        self,
        hits: Hits,
        throughput: Floats32,
        boundary: Boundary | None,
        path: Indices | None,
        medium: Media | None,
        depth: int,
        draws: Draws,
    ) -> Rays | None:
        """Refracted rays if ``boundary`` is given, otherwise reflected rays.

        ``throughput`` (3, n) includes the bounce.
        """
        which = np.flatnonzero(throughput.max(axis=0) > self.cutoff)
        if len(which) == 0:
            return None
        path = which if path is None else path.take(which)
        origin, throughput = self.origins(hits, which, 0 if boundary else len(which), throughput)
        if boundary is None:
            direction = self.mirrored(hits, which, path, depth, draws)
        else:
            direction = self.refracted(hits, which, boundary.of(which), path, depth, draws)
        count = self.weights(hits, which, direction, boundary is not None)
        if count is not None:
            throughput = throughput * count
        draws.cast("reflection" if boundary is None else "refraction", len(which), path)
        start = None
        if medium is not None:
            medium = medium.take(which) if boundary is None else self.medium_behind(hits, which)
            start = hits.p.take(which, axis=1)
        time = None if hits.time is None else hits.time.take(which)
        return Rays(origin, direction, throughput, path, medium, time, start)


def kept_above(direction: Floats32, ng: Floats32) -> Floats32:
    """Reflect directions (3, n) that point into the surface, so that they point out; ng (3, n): geometric normals."""
    below = np.minimum(dot(direction, ng), 0)
    if not below.any():
        return direction
    return np.subtract(direction, (below + below) * ng)
