"""Where paths go on: one ray for each hit, whichever of its ways the light takes.

A surface may scatter, mirror and refract at once. Of these ways one is chosen, as probable as the throughput that it
would leave is large, and the throughput is divided by that probability. So the mean is right, and the number of rays
doesn't grow.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats32, Indices, Mask, Media
from course.geometry.hits import Hits
from course.geometry.leaving import kept_above
from course.scene.world import Paths
from course.transport.gloss import Blur
from course.transport.insides import insides
from course.transport.paths import OPEN, Draws, Rays
from course.transport.plan import Lookups, Plan
from course.transport.ways import beyond, departures, divided, mirrored, reflectance, refracted

DIFFUSE, MIRRORED, REFRACTED = range(3)

LEAST = np.float32(1e-30)
"""Below any throughput that is worth a thought; keeps a division by zero away."""

_ALL, _NONE = np.ones((3, 1), np.float32), np.empty(0, np.float32)


@dataclass(frozen=True)
class PathBounce:
    """Sends the paths of one depth on.

    Attributes
    ----------
    first : what the dimensions of this depth begin with, more than those of depth 0
    optical : (M,) which materials mirror or refract
    survival : whether Russian roulette is played at this depth
    """

    plan: Plan
    lookups: Lookups
    paths: Paths
    draws: Draws
    first: int
    optical: Mask
    survival: bool

    def __call__(
        self,
        hits: Hits,
        beta: Floats32 | None,
        path: Indices | None,
        medium: Media | None,
        blur: Blur | None,
    ) -> tuple[Rays, Mask | None] | None:
        """The rays that go on, and which of them left a mirror or glass (None for none); None if all paths end.

        Parameters
        ----------
        beta : (3, n) float32 throughput of the rays that hit, or None for 1
        path : (n,) or None for all paths in order
        medium : (n,) the material that the arriving ray travelled in, or None where nothing absorbs
        """
        after = self._scattered(hits, beta)
        other, boundary, kind = None, None, None
        if self.plan.mirrors or self.plan.refracts:
            other = np.flatnonzero(self.optical.take(hits.material))
        u = None
        if self.survival or (other is not None and len(other)):
            assert self.plan.choice_dimension is not None
            # One pair for both: which way the light takes, and whether the path survives.
            first = self.plan.choice_dimension + self.first
            if other is None or len(other) == 0:
                u = self.draws("choice", first + 1, 1, path)
            else:
                u = self.draws("choice", first, 2, path)
        if u is not None and other is not None and len(other):
            shares = None
            if self.plan.refracts:
                *shares, boundary = divided(self.plan, self.lookups, hits, other, blur)
            after, kind = self._chosen(hits, beta, after, other, shares, u[0])
        goes_on, after = self._survivors(after, u)
        # From here on rays that take the same way stand together: their directions are joined, which costs less than
        # to spread them, and neighbours in Embree's packets have more in common.
        which, optical, crossing = _ordered(goes_on, kind, hits.compiled)
        if len(which) == 0:
            return None
        if self.plan.absorbs and medium is None:
            medium = np.full(hits.size, OPEN)
        whole = kind is None and len(which) == hits.size
        start = None
        if medium is not None:
            start = hits.p if whole else hits.p.take(which, axis=1)
        origin = hits.above
        if not whole:
            origin, after = departures(hits, which, crossing, after)
            path = which if path is None else path.take(which)
            medium = None if medium is None else medium.take(which)
        elif path is None:
            path = which
        time = None if hits.time is None else hits.time.take(which)
        if kind is None:
            direction = self._diffuse(hits, None if whole else which, path)
            left = hits.leaving(which, direction)
            return Rays(origin, direction, after, path, medium, time, left, start), None
        scattered, back, through = which[:optical], which[optical:crossing], which[crossing:]
        directions = [self._diffuse(hits, scattered, path[:optical])] if optical else []
        if len(back):
            ng = hits.ng.take(back, axis=1)
            directions.append(mirrored(self.plan, hits, back, ng, path[optical:crossing], blur))
        if len(through):
            assert other is not None
            assert boundary is not None
            # Where among those on mirrors and glass the refracted ones are: both in the order of the hits.
            refracts = goes_on.take(other) & (kind.take(other) == REFRACTED)
            within = boundary.of(np.flatnonzero(refracts))
            directions.append(refracted(self.plan, hits, through, within, path[crossing:], blur))
            if medium is not None:
                medium[crossing:] = beyond(self.lookups, hits, through)
        direction = np.concatenate(directions, axis=1)
        left = hits.leaving(which, direction)
        rays = Rays(origin, direction, after, path, medium, time, left, start)
        return rays, np.arange(len(which)) >= optical

    def _scattered(self, hits: Hits, beta: Floats32 | None) -> Floats32:
        """Throughput (3, n) of diffuse reflection."""
        if self.paths.throughput is None:
            return np.zeros((3, hits.size), np.float32)
        if beta is None:
            beta = np.ones((3, hits.size), np.float32)
        albedo = self.lookups.diffuse(hits.material)
        if albedo.shape[1] != hits.size:
            albedo = np.repeat(albedo, hits.size, axis=1)
        if hits.tint is not None:
            albedo = albedo * hits.tint
        inside = insides(self.plan, self.lookups, hits)
        if len(inside):
            albedo = albedo.copy()
            albedo[:, inside] = 0
        return self.paths.throughput(beta, albedo)

    def _chosen(
        self,
        hits: Hits,
        beta: Floats32 | None,
        diffuse: Floats32,
        other: Indices,
        shares: Sequence[Floats32] | None,
        u: Floats32,
    ) -> tuple[Floats32, NDArray[np.int8]]:
        """Throughputs (3, n) and the way of each hit, by chance where it could take another than the diffuse one.

        Parameters
        ----------
        diffuse : (3, n) throughput of diffuse reflection
        other : (m,) the hits on materials that mirror or refract
        shares : (m,) each, of the light that their boundary reflects and refracts; None where nothing refracts
        u : (n,) in [0, 1)
        """
        mirror = reflectance(self.lookups, hits, other)
        after = np.array(diffuse, np.float32)
        kind = np.full(hits.size, DIFFUSE, np.int8)
        if hits.compiled:
            from course.transport import way_kernels

            arrays = (_ALL if beta is None else beta, mirror, *(shares or (_NONE, _NONE)), u)
            way_kernels.choose(other, *map(np.ascontiguousarray, arrays), after, kind)
            return after, kind
        arriving = np.float32(1) if beta is None else beta.take(other, axis=1)
        ways = [diffuse.take(other, axis=1)]
        if shares is not None:
            ways += [(mirror + shares[0]) * arriving, shares[1] * arriving]
        else:
            ways += [mirror * arriving]
        odds = np.stack([np.broadcast_to(way, ways[0].shape).max(axis=0) for way in ways])
        reach = np.cumsum(odds, axis=0)
        # Where nothing is left the last way is as good as any: its throughput is 0.
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

    def _survivors(self, after: Floats32, u: Floats32 | None) -> tuple[Mask, Floats32]:
        """Which paths go on (n,), and the throughput (3, n) of all."""
        if self.survival and u is not None and self.paths.russian_roulette is not None:
            return self.paths.russian_roulette(after, u[-1])
        return after.max(axis=0) > 0, after

    def _diffuse(self, hits: Hits, which: Indices | None, path: Indices) -> Floats32:
        """Directions in which paths leave some of the hits, or all of them."""
        assert self.plan.bounce_dimension is not None
        assert self.paths.diffuse_bounce is not None
        u = self.draws("bounce", self.plan.bounce_dimension + self.first, 2, path)
        ns, ng = hits.ns, hits.ng
        if which is not None:
            ns = ns.take(which, axis=1)
        direction = self.paths.diffuse_bounce(ns, u)
        if hits.ns is hits.ng:
            return direction
        return kept_above(direction, ng if which is None else ng.take(which, axis=1))


def _ordered(
    goes_on: Mask, kind: NDArray[np.int8] | None, compiled: bool
) -> tuple[Indices, int, int]:
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
    if compiled:
        from course.transport import way_kernels

        which, counts = np.empty(len(kind) + 1, np.int64), np.empty(3, np.int64)
        total = way_kernels.sort(np.ascontiguousarray(goes_on), kind, which, counts)
        return which[:total], int(counts[0]), int(counts[0] + counts[1])
    which = np.flatnonzero(goes_on)
    taken = kind.take(which)
    ways = [which.compress(taken == way) for way in (DIFFUSE, MIRRORED, REFRACTED)]
    return np.concatenate(ways), len(ways[0]), len(ways[0]) + len(ways[1])
