"""Arguments to call a function with: as a scene has them, round ones for examples, and the ends of what is legal."""

from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array

SEVEN = np.array(
    [(0, 0, 1), (1, 0, 0), (0, -1, 0), (0.6, 0, 0.8), (0, 0.6, -0.8), (-0.8, 0, 0.6), (0, 0, -1)]
).T
"""Unit vectors of round numbers, (3, 7)."""


@dataclass(frozen=True)
class Draw:
    """Where arguments are drawn from.

    Attributes
    ----------
    rng : numbers
    n : columns of the batches
    dtype : of the batches
    scale : factor of all lengths
    simple : whether all numbers are to be round ones, to be read by a person
    """

    rng: np.random.Generator
    n: int
    dtype: Any = np.float32
    scale: float = 1.0
    simple: bool = False

    def units(self, rows: int, n: int | None = None) -> Array:
        """(rows, n) numbers u in [0, 1), of the batches' dtype."""
        shape = (rows, self.n if n is None else n)
        if self.simple:
            return (self.rng.integers(0, 4, shape) / 4).astype(self.dtype)
        return self.rng.random(shape, self.dtype)

    def uniform(self, low: float, high: float, *shape: int) -> Array:
        """Numbers in [low, high), of shape () if none is given."""
        found = self.rng.uniform(low, high, shape)
        if self.simple:
            step = 0.5 if high - low < 3 else 1.0
            rounded = np.round(found / step) * step
            found = np.where((rounded >= low) & (rounded <= high), rounded, found)
        return np.asarray(found)

    def number(self, low: float, high: float) -> float:
        """One number, its logarithm uniform: both must be over 0."""
        if self.simple:
            round_ones = [x for x in (0.25, 0.5, 1.0, 2.0, 4.0, 16.0) if low <= x <= high]
            if round_ones:
                return float(self.rng.choice(round_ones))
        return float(np.exp(self.rng.uniform(np.log(low), np.log(high))))

    def lengths(self, low: float, high: float, *shape: int) -> Array:
        """Lengths [m], uniform."""
        return self.scale * self.uniform(low, high, *shape)

    def directions(self, n: int | None = None) -> Array:
        """(3, n) unit vectors of float64, uniform over the sphere."""
        count = self.n if n is None else n
        if self.simple:
            return SEVEN[:, self.rng.integers(0, SEVEN.shape[1], count)].astype(float)
        v = self.rng.standard_normal((3, count))
        return np.asarray(v / np.linalg.norm(v, axis=0))

    def frame(self) -> Array:
        """Three orthonormal rows; the first two and their cross product, a right-handed frame."""
        if self.simple:
            return np.eye(3)
        w, other = self.rng.standard_normal((2, 3))
        w /= np.linalg.norm(w)
        u = np.cross(w, other)
        u /= np.linalg.norm(u)
        return np.stack((u, np.cross(w, u), w))

    def but(self, **changed: Any) -> "Draw":
        """The same with other attributes."""
        return replace(self, **changed)


def worst_units(rows: int, dtype: Any) -> Array:
    """Every combination of the ends of [0, 1), of their neighbours and of the middle, a column each."""
    dtype = np.dtype(dtype)
    last = float(np.nextafter(dtype.type(1), dtype.type(0)))
    ends = [0.0, float(np.finfo(dtype).tiny), 0.5, 1 - 2.0**-24, last]
    return np.array([*product(ends, repeat=rows)], dtype).T.copy()


def worst_directions(dtype: Any) -> Array:
    """Unit vectors on and around the axes, the diagonals and the equator."""
    steep = (0.00038527316, 0.00038460016, -0.99999988079)
    offsets = (0.0, 1e-38, 1e-20, 1e-8, 3e-8, 1e-7, 1e-4, 0.01)
    vectors: list[Any] = [(a, b, 1.0) for a, b in product(offsets, repeat=2)]
    vectors += [(1.0, 1.0, b) for b in offsets] + [(1.0, 1.0, 1.0), (0.6, 0.0, 0.8)]
    normalised = [np.array(v) / np.linalg.norm(v) for v in vectors]
    turned = [np.roll(v, k) for v in [*normalised, np.array(steep)] for k in range(3)]
    signs = [np.array(s) for s in product((1.0, -1.0), repeat=3)]
    return np.array([v * s for v in turned for s in signs], dtype).T.copy()
