"""The photons of a pass in a tree, and what they bring to points; passes are made when they are first asked for."""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from course.engine.core.types import Floats32, Functions, Indices
from course.engine.terms.photons.flight import Photons

PAIRS = 1 << 21
"""Pairs of a point and a photon that are looked at together: 100 MB."""

KEPT = 1 << 22
"""Photons that all passes in memory may have together; a pass that has been thrown away is made again when it is
asked for. Each takes about 120 bytes: 500 MB."""


NEAREST = np.float32(1e-3)
"""Least radius of the disk of the nearest photons, in that of all that are looked for: rounding moves them about."""


@dataclass(frozen=True)
class Estimate:
    """How photons around a point become irradiance.

    Attributes
    ----------
    cone : how flat the filter of all within the radius is
    nearest : how many photons count, the nearest within the radius; None for all
    """

    cone: float
    nearest: int | None = None

    @property
    def functions(self) -> set[str]:
        """The module's functions that it calls."""
        return {"cone_weights" if self.nearest is None else "density_estimate"}


@dataclass(frozen=True)
class PhotonMap:
    """Photons of a pass, to be looked for.

    Attributes
    ----------
    radius : of the disk around a point
    low, high : (3, 1) the box of all photons, that much wider; None without a photon
    """

    photons: Photons
    radius: float
    tree: Any = None
    low: Floats32 | None = None
    high: Floats32 | None = None

    @classmethod
    def of(cls, photons: Photons, radius: float) -> "PhotonMap":
        """The map; none is looked for where there are none."""
        if not photons.count:
            return cls(photons, radius)
        position, wide = photons.position, np.float32(radius * (1 + 1e-5))
        low, high = position.min(axis=1)[:, None] - wide, position.max(axis=1)[:, None] + wide
        tree = cKDTree(position.T, balanced_tree=False, compact_nodes=True)
        return cls(photons, radius, tree, low, high)

    def irradiance(
        self, points: Floats32, normal: Floats32, module: Functions, estimate: Estimate
    ) -> tuple[Indices, Floats32]:
        """Which of points (3, n) get light, and how much (3, m)."""
        if self.tree is None or self.low is None or self.high is None:
            return np.empty(0, np.intp), np.empty((3, 0), np.float32)
        near = np.flatnonzero(((points >= self.low) & (points <= self.high)).all(axis=0))
        counts = self._counted(points, near)
        near, counts = near.compress(counts > 0), counts.compress(counts > 0)
        if estimate.nearest is not None:
            counts = np.full(len(near), estimate.nearest)
        found = np.zeros((3, len(near)), np.float32)
        ends = np.cumsum(counts)
        first = 0
        while first < len(near):
            before = int(ends[first - 1]) if first else 0
            last = max(int(np.searchsorted(ends, before + PAIRS, side="right")), first + 1)
            some = near[first:last]
            if estimate.nearest is None:
                found[:, first:last] = self._summed(points, normal, some, module, estimate)
            else:
                found[:, first:last] = self._of_nearest(
                    points, normal, some, module, estimate.nearest
                )
            first = last
        return near, found

    def _counted(self, points: Floats32, near: Indices) -> Indices:
        if not len(near):
            return np.empty(0, np.intp)
        query = points.take(near, axis=1).T
        return np.asarray(self.tree.query_ball_point(query, self.radius, return_length=True))

    def _summed(
        self,
        points: Floats32,
        normal: Floats32,
        some: Indices,
        module: Functions,
        estimate: Estimate,
    ) -> Floats32:
        """Irradiance (3, m) at some points, by all photons within the radius."""
        point, _, power = self.pairs(points, normal, some, module, estimate)
        sums = [np.bincount(point, row, len(some)) for row in power]
        return np.asarray(sums, np.float32)

    def _of_nearest(
        self, points: Floats32, normal: Floats32, some: Indices, module: Functions, most: int
    ) -> Floats32:
        """Irradiance (3, m) at some points, by the nearest photons within the radius.

        Where there are fewer, the others are photons at the radius without power: the disk is no larger.
        """
        query, own = points.take(some, axis=1).T, normal.take(some, axis=1)
        distance, photon = self.tree.query(query, most, distance_upper_bound=self.radius)
        distance, photon = distance.reshape(-1, most).T, photon.reshape(-1, most).T
        there = photon < self.photons.count
        photon = np.where(there, photon, 0)
        power = np.where(there, self.photons.power.take(photon, axis=1), 0)
        way = np.where(there, self.photons.direction.take(photon, axis=1), -own[:, None])
        radius = np.float32(self.radius)
        far = np.clip(distance.astype(np.float32), NEAREST * radius, radius)
        arrays = power.astype(np.float32), way.astype(np.float32), far, own
        found: Floats32 = module.density_estimate(*map(np.ascontiguousarray, arrays))
        return found

    def pairs(
        self,
        points: Floats32,
        normal: Floats32,
        some: Indices,
        module: Functions,
        estimate: Estimate,
    ) -> tuple[Indices, Indices, Floats32]:
        """Pairs of a point, among some, and a photon near it; what the photon brings there (3, m) [W/m^2]."""
        query = cKDTree(points.take(some, axis=1).T, balanced_tree=False)
        pairs = query.sparse_distance_matrix(self.tree, self.radius, output_type="ndarray")
        point, photon = pairs["i"], pairs["j"]
        way = self.photons.direction.take(photon, axis=1)
        facing = np.einsum("cn,cn->n", way, normal.take(some, axis=1).take(point, axis=1))
        seen = np.flatnonzero(facing < 0)
        point, photon = point.take(seen), photon.take(seen)
        distance = pairs["v"].take(seen).astype(np.float32)
        power = self.photons.power.take(photon, axis=1)
        if estimate.nearest is not None:
            # For whom is told of them: shares of what the nearest bring together.
            return point, photon, power
        wide = np.full(len(seen), self.radius, np.float32)
        return (
            point,
            photon,
            power * module.cone_weights(np.minimum(distance, wide), wide, estimate.cone),
        )


@dataclass
class Maps:
    """The maps of passes that were asked for last; a key has all that a pass hangs on."""

    known: OrderedDict[Any, PhotonMap] = field(default_factory=OrderedDict)
    lock: Any = field(default_factory=Lock, repr=False)

    def of(self, key: Any, make: Callable[[], PhotonMap]) -> PhotonMap:
        """The map of a pass. One thread makes it, and others wait for it."""
        with self.lock:
            if key not in self.known:
                made = make()
                while self.known and self._size() + made.photons.count > KEPT:
                    self.known.popitem(last=False)
                self.known[key] = made
            self.known.move_to_end(key)
            return self.known[key]

    def _size(self) -> int:
        return sum(each.photons.count for each in self.known.values())
