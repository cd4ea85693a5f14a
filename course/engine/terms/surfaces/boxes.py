"""Boxes around triangles, and a tree of boxes that says which of them a batch of rays may meet."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Indices

ROOM = np.float32(1e-6)
"""Share by which distances to a box are stretched: several times their rounding in float32."""


def roomy_box(vertices: Floats32) -> Floats32:
    """Lowest and highest corner (2, 3) of a box around all vertices, with room for the rounding of Embree's hits."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    room = np.float32(1e-5) * (high - low).max() + np.float32(1e-6) * np.abs(vertices).max()
    return np.array((low - room, high + room), np.float32)


@dataclass(frozen=True)
class BoxTree:
    """A box around some of K boxes.

    Attributes
    ----------
    low, high : (3, 1) float32
    number : the box, if it is one; -1 if there are ``parts``
    parts : trees of the first and of the second half of the boxes; none if it is one box
    """

    low: Floats32
    high: Floats32
    number: int
    parts: tuple[BoxTree, ...] = ()

    def met(
        self, origin: Floats32, direction: Floats32, limit: Floats32, which: Indices
    ) -> dict[int, Indices]:
        """Which rays may meet each box: box -> indices (m,) of rays, in ascending order; no box without rays is in it.

        Parameters
        ----------
        origin, direction : (3, N) float32
        limit : (N,) float32 [length of the direction]
        which : (n,) the rays to be tested
        """
        found: dict[int, Indices] = {}
        if len(which) < len(limit):
            limit = limit.take(which)
            origin, direction = origin.take(which, axis=1), direction.take(which, axis=1)
        # A component next to 0 makes infinite distances, and a NaN only where the ray lies in the plane of a side.
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            self._collect(origin, np.float32(1) / direction, limit, which, found)
        return found

    def _collect(
        self,
        origin: Floats32,
        inverse: Floats32,
        limit: Floats32,
        which: Indices,
        found: dict[int, Indices],
    ) -> None:
        a, b = (self.low - origin) * inverse, (self.high - origin) * inverse
        near, far = np.fmin(a, b).max(axis=0, initial=0), np.fmax(a, b, out=b)
        farthest = np.fmin(far.min(axis=0), limit)
        near *= 1 - ROOM
        farthest *= 1 + ROOM
        inside = np.flatnonzero(near <= farthest)
        if len(inside) == 0:
            return
        if len(inside) < len(which):
            which, limit = which.take(inside), limit.take(inside)
            origin, inverse = origin.take(inside, axis=1), inverse.take(inside, axis=1)
        if not self.parts:
            found[self.number] = which
        for part in self.parts:
            part._collect(origin, inverse, limit, which, found)


def box_tree(boxes: Floats32, numbers: Indices | None = None) -> BoxTree:
    """The tree of boxes (K, 2, 3), or of some of them (k,), k > 0, halved where they lie farthest apart."""
    numbers = np.arange(len(boxes)) if numbers is None else numbers
    low, high = boxes[numbers, 0].min(axis=0), boxes[numbers, 1].max(axis=0)
    corners = low[:, None], high[:, None]
    if len(numbers) == 1:
        return BoxTree(*corners, int(numbers[0]))
    middle = boxes[numbers].mean(axis=1)
    axis = np.ptp(middle, axis=0).argmax()
    halves = np.array_split(numbers[middle[:, axis].argsort(kind="stable")], 2)
    return BoxTree(*corners, -1, tuple(box_tree(boxes, half) for half in halves))
