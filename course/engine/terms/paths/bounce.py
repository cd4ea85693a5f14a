"""The bounces of paths: one ray for each hit, which is diffuse, mirrored or refracted.

A surface may scatter, mirror and refract at once. One of these is chosen with a probability in proportion to its
throughput, and the throughput is divided by that probability. So the mean is right, and the number of rays doesn't
grow.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.hits import Hits, Surface
from course.engine.core.materials import Lookup
from course.engine.core.rays import OPEN, Draws, Rays
from course.engine.core.scatter import Boundary, Scatter, kept_above
from course.engine.core.types import Floats32, Functions, Indices, Mask, Media
from course.engine.terms.paths.russian_roulette import survivors

DIFFUSE, MIRRORED, REFRACTED = range(3)

LEAST = np.float32(1e-30)
"""Below any throughput that is worth a thought; keeps a division by zero away."""


@dataclass(frozen=True)
class PathBounce:
    """Sends the paths of one depth on.

    Attributes
    ----------
    scatter : mirrors and refracts; None where nothing does
    optical : (M,) which materials mirror or refract
    diffuse : (3, M) share of the light that a surface returns
    path_tracing : functions of the module; None where nothing scatters
    roulette : bounces that a path makes before Russian roulette may end it, None for never
    """

    surface: Surface
    scatter: Scatter | None
    optical: Mask
    diffuse: Lookup
    path_tracing: Functions | None
    roulette: int | None

    def __call__(
        self,
        hits: Hits,
        beta: Floats32 | None,
        path: Indices | None,
        medium: Media | None,
        inside: Indices,
        depth: int,
        draws: Draws,
    ) -> tuple[Rays, Mask | None] | None:
        """The rays that go on, and which of them left a mirror or glass (None for none); None if all paths end.

        Parameters
        ----------
        beta : (3, n) float32 throughput of the rays that hit, or None for 1
        path : (n,) or None for all paths in order
        medium : (n,) the material that the arriving ray travelled in, or None where nothing absorbs
        inside : the hits that are on the inside of a dielectric that is dark there
        """
        if draws.watcher is not None:
            draws.watcher.bounces(None)
        after = self._scattered(hits, beta, inside)
        other, boundary, kind = None, None, None
        survival = self.roulette is not None and depth >= self.roulette
        if self.scatter is not None:
            other = np.flatnonzero(self.optical.take(hits.material))
        u = None
        if survival or (other is not None and len(other)):
            # One pair for both: which way the light takes, and whether the path survives.
            if other is None or len(other) == 0:
                u = draws("choice", path, depth, 1, skip=1)
            else:
                u = draws("choice", path, depth)
        if u is not None and self.scatter is not None and other is not None and len(other):
            if self.scatter.index is not None:
                way = other if path is None else path.take(other)
                boundary = self.scatter.boundary(hits, other, way, depth, draws)
            after, kind = self._chosen(self.scatter, hits, beta, after, other, boundary, u[0])
        goes_on, after = survivors(
            self.path_tracing, after, u[-1] if survival and u is not None else None
        )
        # From here on rays that take the same way stand together: their directions are joined, which costs less than
        # to spread them, and neighbours in Embree's packets have more in common.
        which, optical, crossing = self._ordered(goes_on, kind)
        if len(which) == 0:
            return None
        if self.scatter is not None and self.scatter.absorbs and medium is None:
            medium = np.full(hits.size, OPEN)
        whole = kind is None and len(which) == hits.size
        start = None
        if medium is not None:
            start = hits.p if whole else hits.p.take(which, axis=1)
        origin = hits.near_origin
        if not whole:
            origin, after = self._origins(hits, which, crossing, after)
            path = which if path is None else path.take(which)
            medium = None if medium is None else medium.take(which)
        elif path is None:
            path = which
        time = None if hits.time is None else hits.time.take(which)
        draws.cast("path", len(which), path)
        if kind is None or self.scatter is None:
            direction = self._diffuse(hits, None if whole else which, path, depth, draws)
            return Rays(origin, direction, after, path, medium, time, start), None
        scattered, back, through = which[:optical], which[optical:crossing], which[crossing:]
        directions = []
        if optical:
            directions.append(self._diffuse(hits, scattered, path[:optical], depth, draws))
        if len(back):
            mirrored = self.scatter.mirrored(hits, back, path[optical:crossing], depth, draws)
            directions.append(mirrored)
            self._weigh(after[:, optical:crossing], hits, back, mirrored, False)
        if len(through):
            assert other is not None
            assert boundary is not None
            # Positions of the refracted paths among those on mirrors and glass; both are in the order of the hits.
            refracts = goes_on.take(other) & (kind.take(other) == REFRACTED)
            within = boundary.of(np.flatnonzero(refracts))
            refracted = self.scatter.refracted(hits, through, within, path[crossing:], depth, draws)
            directions.append(refracted)
            self._weigh(after[:, crossing:], hits, through, refracted, True)
            if medium is not None:
                medium[crossing:] = self.scatter.medium_behind(hits, through)
        direction = np.concatenate(directions, axis=1)
        rays = Rays(origin, direction, after, path, medium, time, start)
        return rays, np.arange(len(which)) >= optical

    def _weigh(
        self, after: Floats32, hits: Hits, which: Indices, way: Floats32, through: bool
    ) -> None:
        """Multiply the throughput (3, m) of mirrored or refracted rays by what their directions count."""
        count = None if self.scatter is None else self.scatter.weights(hits, which, way, through)
        if count is not None:
            after *= count

    def _origins(
        self, hits: Hits, which: Indices, near: int, after: Floats32
    ) -> tuple[Floats32, Floats32]:
        """See ``Scatter.origins``."""
        if self.scatter is not None:
            return self.scatter.origins(hits, which, near, after)
        return hits.near_origin.take(which, axis=1), after.take(which, axis=1)

    def _scattered(self, hits: Hits, beta: Floats32 | None, inside: Indices) -> Floats32:
        """Throughput (3, n) of diffuse reflection."""
        if self.path_tracing is None:
            return np.zeros((3, hits.size), np.float32)
        if beta is None:
            beta = np.ones((3, hits.size), np.float32)
        albedo = self.diffuse(hits.material)
        if albedo.shape[1] != hits.size:
            albedo = np.repeat(albedo, hits.size, axis=1)
        if hits.tint is not None:
            albedo = albedo * hits.tint
        if len(inside):
            albedo = albedo.copy()
            albedo[:, inside] = 0
        after: Floats32 = self.path_tracing.throughput(beta, albedo)
        return after

    def _chosen(
        self,
        scatter: Scatter,
        hits: Hits,
        beta: Floats32 | None,
        diffuse: Floats32,
        other: Indices,
        boundary: Boundary | None,
        u: Floats32,
    ) -> tuple[Floats32, NDArray[np.int8]]:
        """Throughputs (3, n) and the way of each hit, by chance where it could take another than the diffuse one.

        Parameters
        ----------
        diffuse : (3, n) throughput of diffuse reflection
        other : (m,) the hits on materials that mirror or refract
        boundary : of these; None where nothing refracts
        u : (n,) in [0, 1)
        """
        mirror = scatter.reflectance(hits, other)
        after = np.array(diffuse, np.float32)
        kind = np.full(hits.size, DIFFUSE, np.int8)
        arriving = np.float32(1) if beta is None else beta.take(other, axis=1)
        ways = [diffuse.take(other, axis=1)]
        if boundary is not None:
            ways += [(mirror + boundary.reflected) * arriving, boundary.refracted * arriving]
        else:
            ways += [mirror * arriving]
        odds = np.stack([np.broadcast_to(way, ways[0].shape).max(axis=0) for way in ways])
        reach = np.cumsum(odds, axis=0)
        # If all throughputs are 0, the last one is chosen, which makes no difference.
        way_taken = (u.take(other) * reach[-1] >= reach[:-1]).sum(axis=0)
        weight = np.zeros(ways[0].shape, np.float32)
        for number, way in enumerate(ways):
            # Over its probability, odds / reach[-1]. A way is at most its odds, so that nothing
            # overflows in this order, whatever the others carry.
            np.copyto(
                weight, way * (1 / np.maximum(odds[number], LEAST)), where=way_taken == number
            )
        after[:, other] = weight * reach[-1]
        kind[other] = way_taken
        return after, kind

    def _diffuse(
        self, hits: Hits, which: Indices | None, path: Indices, depth: int, draws: Draws
    ) -> Floats32:
        """Directions in which paths leave some of the hits, or all of them."""
        assert self.path_tracing is not None
        if draws.watcher is not None:
            draws.watcher.bounces(path)
        u = draws("bounce", path, depth)
        ns, ng = hits.ns, hits.ng
        if which is not None:
            ns = ns.take(which, axis=1)
        direction: Floats32 = self.path_tracing.diffuse_bounce(ns, u)
        if hits.ns is hits.ng:
            return direction
        return kept_above(direction, ng if which is None else ng.take(which, axis=1))

    def _ordered(self, goes_on: Mask, kind: NDArray[np.int8] | None) -> tuple[Indices, int, int]:
        """The hits that paths go on from, by the way that they take from there.

        Parameters
        ----------
        goes_on : (n,) whether a path goes on
        kind : (n,) its way; None where all are scattered

        Returns
        -------
        which : (m,) first those that are scattered, then those mirrored, then those refracted
        scattered : how many are
        above : how many are scattered or mirrored
        """
        if kind is None:
            which = np.flatnonzero(goes_on)
            return which, len(which), len(which)
        which = np.flatnonzero(goes_on)
        taken = kind.take(which)
        ways = [which.compress(taken == way) for way in (DIFFUSE, MIRRORED, REFRACTED)]
        return np.concatenate(ways), len(ways[0]), len(ways[0]) + len(ways[1])
