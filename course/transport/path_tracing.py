"""Path tracing: each camera ray is followed from surface to surface, and brings all light, however it came.

Kajiya, "The rendering equation", 1986. Light reaches a diffuse surface in two ways: from lamps and the environment,
for which direct light casts its shadow rays at every hit, and from other surfaces, for which the path goes on. A ray
that has left a diffuse surface and runs into a lamp, or out into the environment, has found what a shadow ray has
already counted, so it adds nothing; after a mirror or glass, where no shadow rays are cast, it does. Lamps are lights
with a surface, from its front, and objects that are lights, from both sides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from course.core.samplers.sobol import SobolSampler
from course.core.types import Floats32, Indices, Mask
from course.geometry.hits import Hits
from course.imaging.tiles import RAYS
from course.scene.world import Paths
from course.transport.direct import direct_light
from course.transport.insides import insides
from course.transport.path_bounce import PathBounce
from course.transport.path_pieces import Piece, Pieces
from course.transport.paths import Draws, Rays
from course.transport.tracing import CancelledError, Tracer, add_radiance


@dataclass(frozen=True)
class Glow:
    """Light that M materials give off.

    Attributes
    ----------
    radiance : (3, M) float32
    which : (M,) those that give off any
    """

    radiance: Floats32
    which: Mask


@dataclass(frozen=True)
class PathTracer(Tracer):
    """A tracer that follows each path to its end; the camera and the film are the distribution ray tracer's."""

    @property
    def batches(self) -> int:
        """Batches of rays in a tile: most paths end soon, and the few that are left of several batches make one."""
        # Sobol points are each pixel's own; those of other samplers belong to a tile, which can't be divided.
        return 16 if isinstance(self.sampler, SobolSampler) and self._paths.together else 1

    @cached_property
    def _paths(self) -> Paths:
        assert self.world.paths is not None
        return self.world.paths

    @cached_property
    def _optical(self) -> Mask:
        """(M,) which materials mirror or refract."""
        materials = self.world.materials
        return np.asarray(materials.refracts | (materials.mirror.max(axis=0) > 0))

    @cached_property
    def _glow(self) -> Glow | None:
        """Light that surfaces give off and that no shadow ray looks for: it counts whenever a path meets it."""
        looked_for = self._paths.lamps | self._paths.objects
        return _glow(self.world.materials.emission * ~looked_for)

    @cached_property
    def _ambient(self) -> Glow | None:
        """Ambient light, the same at every point of a surface: as if the surface gave it off."""
        return _glow(self.world.materials.ambient * self.world.ambient[:, None])

    @cached_property
    def _lamps(self) -> Glow | None:
        """Light that shadow rays look for, of the fronts of lights."""
        rows = self.world.materials.emission * self._paths.lamps
        return _glow(rows)

    @cached_property
    def _objects(self) -> Glow | None:
        """Light that shadow rays look for, of both sides of objects."""
        rows = self.world.materials.emission * self._paths.objects
        return _glow(rows)

    def _trace(self, camera_rays: Rays, paths: int, draws: Draws) -> Floats32:
        """Radiance (3, paths) that the paths bring back."""
        film = np.zeros((3, paths), np.float32)
        pieces = Pieces(draws, film)
        for piece in pieces.cut(camera_rays, self.batches):
            self._advance(piece, 0, pieces, RAYS // 2)
        while (rest := pieces.shallowest()) is not None:
            self._advance(*rest, pieces, 0)
        return film

    def _advance(self, piece: Piece | None, depth: int, pieces: Pieces, least: int) -> None:
        """Follow paths to their ends, or until fewer than ``least`` are left, which wait for others."""
        while piece is not None:
            if piece.draws.cancelled():
                raise CancelledError
            rest = self._step(piece.rays, piece.sees, depth, piece.film, piece.draws)
            if rest is None:
                return
            depth += 1
            piece = pieces.joined(replace(piece, rays=rest[0], sees=rest[1]), depth, least)

    def _step(
        self,
        rays: Rays,
        sees: Mask | None,
        depth: int,
        film: Floats32,
        draws: Draws,
    ) -> tuple[Rays, Mask | None] | None:
        """One depth: what the rays bring is added to the film, and the rays that go on are returned.

        Parameters
        ----------
        sees : (n,) which rays bring light from lamps and the environment; None for none of them
        """
        counters = draws.counters
        hits, throughput, path, medium = self._met(
            rays, False if sees is None else sees, depth, film, draws
        )
        if sees is not None and hits.ray is not None:
            sees = sees.take(hits.ray)
        if hits.size == 0:
            return None
        radiance = self._light(hits, sees, path, depth, draws)
        if radiance is not None:
            add_radiance(film, path, radiance, throughput, hits.compiled)
        counters.lap("shade")
        if depth == self.plan.max_depth:
            return None
        roulette = self._paths.roulette
        bounce = PathBounce(
            self.plan,
            self.lookups,
            self._paths,
            draws,
            depth * self.plan.bounce_stride,
            self._optical,
            roulette is not None and depth >= roulette,
        )
        following = bounce(hits, throughput, path, medium, self._blur(depth, draws))
        if following is not None:
            counters.rays["path"] = counters.rays.get("path", 0) + following[0].size
        counters.lap("bounce")
        return following

    def _light(
        self, hits: Hits, sees: Mask | None, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Radiance (3, n) that leaves the hits towards the viewer, without what is reflected by another surface."""
        radiance = None
        if self.plan.shades:
            radiance = direct_light(self.world, self.plan, self.lookups, hits, path, depth, draws)
        inside = insides(self.plan, self.lookups, hits)
        outside = None
        if len(inside):
            outside = np.ones(hits.size, np.bool_)
            outside[inside] = False
        if self._ambient is not None:
            radiance = _added(radiance, hits, self._ambient, outside)
        if self._glow is not None:
            radiance = _added(radiance, hits, self._glow, None)
        if hits.tint is not None and self.plan.has_ambient:
            # A texture colours the ambient term, and no other light that a surface gives off.
            change = self.lookups.ambient(hits.material) * (hits.tint - 1)
            if outside is not None:
                change *= outside
            radiance = change if radiance is None else np.add(radiance, change, out=radiance)
        if self._lamps is not None and sees is not None:
            radiance = _added(radiance, hits, self._lamps, sees & hits.entering)
        if self._objects is not None and sees is not None:
            radiance = _added(radiance, hits, self._objects, sees)
        return radiance


def _glow(radiance: Floats32) -> Glow | None:
    return Glow(radiance, np.asarray(radiance.any(axis=0))) if radiance.any() else None


def _added(radiance: Floats32 | None, hits: Hits, glow: Glow, seen: Mask | None) -> Floats32 | None:
    """Radiance (3, n) or None for 0, and what the surfaces that glow add to it, where they are seen or at all hits."""
    glows = glow.which.take(hits.material)
    if seen is not None:
        glows &= seen
    which = np.flatnonzero(glows)
    if len(which) == 0:
        return radiance
    if radiance is None:
        radiance = np.zeros((3, hits.size), np.float32)
    radiance[:, which] += glow.radiance.take(hits.material.take(which), axis=1)
    return radiance
