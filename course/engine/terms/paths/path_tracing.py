"""Path tracing: each camera ray is followed from surface to surface, which gives global illumination.

Kajiya, "The rendering equation", 1986. Light reaches a diffuse surface from lamps and the environment, which shadow
rays sample at every hit (next-event estimation), and from other surfaces, for which the path continues. If a ray from a
diffuse surface hits a lamp or leaves the scene, a shadow ray has counted that light already, so it adds nothing. After
a mirror or glass, where no shadow rays are cast, the light counts. Lamps are the fronts of lights with a surface, and
both sides of objects that are lights.
"""

from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.hits import Hits
from course.engine.core.integrator import CancelledError, Integrator
from course.engine.core.rays import RAYS, Draws, Rays, join_rays
from course.engine.core.types import Floats32, Indices, Mask
from course.engine.terms.lights.multiple_importance import LampsAndLobes
from course.engine.terms.paths.bounce import PathBounce
from course.engine.terms.paths.pieces import Piece, Pieces


class Glow:
    """Light that M materials give off.

    ``radiance``: (3, M) float32
    """

    def __init__(self, radiance: Floats32) -> None:
        self.radiance = radiance
        self._glows = radiance.any(axis=0)

    def added(
        self,
        radiance: Floats32 | None,
        hits: Hits,
        seen: Mask | None,
        share: Floats32 | None = None,
    ) -> Floats32 | None:
        """Radiance (3, n) or None for 0, with what surfaces add that glow, where they are seen or at all hits.

        ``share`` : (n,) or (3, n) of the light that counts; None for all of it
        """
        glows = self._glows.take(hits.material)
        if seen is not None:
            glows &= seen
        which = np.flatnonzero(glows)
        if len(which) == 0:
            return radiance
        if radiance is None:
            radiance = np.zeros((3, hits.size), np.float32)
        light = self.radiance.take(hits.material.take(which), axis=1)
        radiance[:, which] += light if share is None else light * share.take(which, axis=-1)
        return radiance


@dataclass(frozen=True)
class PathIntegrator(Integrator):
    """Follows each path to its end; the camera and the film are the distribution ray tracer's.

    Attributes
    ----------
    bounce : continues paths at surfaces
    pieces : number of batches into which a tile is divided
    unsought : emission that shadow rays don't sample: it counts whenever a path hits it; None if there is none
    reflected : reflected ambient light, treated as emission
    lamps, objects : emission that shadow rays sample, from the fronts of lights and from both sides of objects
    lamps_and_lobes : looks for lamps in glossy surfaces by points on them, too; None where rays alone do
    """

    bounce: PathBounce
    pieces: int
    unsought: Glow | None
    reflected: Glow | None
    lamps: Glow | None
    objects: Glow | None
    lamps_and_lobes: LampsAndLobes | None = None

    def radiance(self, camera_rays: Rays, draws: Draws) -> Floats32:
        """Radiance (3, paths) of the paths; see ``Integrator``."""
        path_radiance = np.zeros((3, draws.block.size), np.float32)
        pieces = Pieces(draws, path_radiance)
        for piece in pieces.cut(camera_rays, self.pieces):
            self._advance(piece, 0, pieces, RAYS // 2)
        while (rest := pieces.shallowest()) is not None:
            self._advance(*rest, pieces, 0)
        return path_radiance

    def _advance(self, piece: Piece | None, depth: int, pieces: Pieces, least: int) -> None:
        """Follow paths to their ends, or until fewer than ``least`` are left, which wait for others."""
        while piece is not None:
            if piece.draws.cancelled():
                raise CancelledError
            rest = self.step(piece.rays, piece.adds_lights, depth, piece.path_radiance, piece.draws)
            if rest is None:
                return
            depth += 1
            piece = pieces.joined(replace(piece, rays=rest[0], adds_lights=rest[1]), depth, least)

    def step(
        self,
        rays: Rays,
        adds_lights: Mask | None,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Rays, Mask | None] | None:
        """Follow rays for one depth: add their radiance, and return the rays of the next depth.

        ``adds_lights``: (n,) bool, rays whose light from lamps and the environment counts; None for none of them
        """
        counters = draws.counters
        came = self.entered(rays, adds_lights, depth, path_radiance, draws)
        rays, adds_lights, here, turned = came
        hits, throughput, path, medium = here.intersect(
            rays, False if adds_lights is None else adds_lights, depth, path_radiance, draws
        )
        if adds_lights is not None and hits.ray is not None:
            adds_lights = adds_lights.take(hits.ray)
        if hits.size == 0:
            return beside(None, turned)
        inside = self.insides(hits)
        both, share = self.lamps_and_lobes, None
        if both is not None:
            share = both.share(rays, hits)
        radiance = self._light(hits, adds_lights, share, inside, path, depth, draws)
        if radiance is not None:
            self.add_radiance(path_radiance, path, radiance, throughput)
        if both is not None and depth < self.max_depth:
            reflected = both.light(hits, throughput, path, depth, draws)
            if reflected is not None:
                self.add_radiance(path_radiance, path, reflected, throughput)
        counters.lap("shade")
        if depth == self.max_depth:
            return beside(None, turned)
        following = self.bounce(hits, throughput, path, medium, inside, depth, draws)
        if both is not None and following is not None:
            following = both.carried(hits, path, following[0]), following[1]
        counters.lap("bounce")
        return beside(following, turned)

    def entered(
        self,
        rays: Rays,
        adds_lights: Mask | None,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Rays, Mask | None, Integrator, tuple[Rays, Mask | None] | None]:
        """Rays as they come to surfaces, and ``adds_lights`` of these; who finds their hits; and rays that turn before.

        Where space is empty all come, and none turns: None.
        """
        return rays, adds_lights, self, None

    def _light(
        self,
        hits: Hits,
        adds_lights: Mask | None,
        share: Floats32 | None,
        inside: Indices,
        path: Indices | None,
        depth: int,
        draws: Draws,
    ) -> Floats32 | None:
        """Radiance (3, n) that leaves the hits towards the viewer, without what is reflected by another surface."""
        radiance = None
        if self.direct is not None:
            radiance = self.direct(hits, path, depth, draws)
        outside = None
        if len(inside):
            outside = np.ones(hits.size, np.bool_)
            outside[inside] = False
        if self.reflected is not None:
            radiance = self.reflected.added(radiance, hits, outside, hits.tint)
        if self.unsought is not None:
            radiance = self.unsought.added(radiance, hits, None)
        if self.lamps is not None and adds_lights is not None:
            radiance = self.lamps.added(radiance, hits, adds_lights & hits.entering, share)
        if self.objects is not None and adds_lights is not None:
            radiance = self.objects.added(radiance, hits, adds_lights)
        return radiance


def beside(
    following: tuple[Rays, Mask | None] | None, turned: tuple[Rays, Mask | None] | None
) -> tuple[Rays, Mask | None] | None:
    """Rays that leave surfaces with rays that come from elsewhere, and which of them add lights."""
    if turned is None or following is None:
        return turned or following
    parts = following, turned
    adds_lights = None
    if any(mask is not None for _, mask in parts):
        adds_lights = np.concatenate(
            [np.zeros(rays.size, np.bool_) if mask is None else mask for rays, mask in parts]
        )
    return join_rays([rays for rays, _ in parts]), adds_lights


def glow(radiance: Floats32) -> Glow | None:
    """Light (3, M) that materials give off; None for none."""
    return Glow(radiance) if radiance.any() else None
