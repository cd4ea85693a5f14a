"""Gradient noise in space (K. Perlin, "Improving noise", 2002), as a colour of surfaces.

Each whole point of space has one of 12 directions, by a table of shuffled numbers. Between them the directions' slopes
are mixed by 6 t^5 - 15 t^4 + 10 t^3, so the noise and its first two derivatives are continuous. It is 0 at all whole
points.
"""

from dataclasses import dataclass
from functools import cache
from itertools import product
from typing import Final

import numpy as np

from course.engine.core.types import Floats32, Indices

PERIOD: Final = 256
"""Whole points after which the table repeats."""

GRADIENTS: Final = np.array(
    [g for g in product((-1, 0, 1), repeat=3) if np.abs(g).sum() == 2], np.float32
)
"""(12, 3): from the middle of a cube to the middles of its edges."""


@cache
def tables() -> tuple[Indices, Floats32]:
    """Shuffled numbers below `PERIOD`, twice over, and directions (3, 2 PERIOD) by their places.

    Places are sums of one of the numbers, a whole point's remainder and 0 or 1. Scenes without noise don't wait for
    NumPy's generators.
    """
    numbers = np.tile(np.random.default_rng(1985).permutation(PERIOD), 2)
    return numbers, np.ascontiguousarray(GRADIENTS[numbers % len(GRADIENTS)].T)


ABSOLUTE = "absolute"


def noise(x: Floats32) -> Floats32:
    """Noise (n,), between -1 and 1, at points (3, n)."""
    cell = np.floor(x)
    t = x - cell
    # The remainder comes first: far away a float32 is a whole number that no integer type holds. It is exact, for the
    # period is a power of 2; places that are no numbers take some cell.
    whole = (cell - np.floor(cell / PERIOD) * PERIOD).astype(np.intp) & (PERIOD - 1)
    fade = t * t * t * (t * (t * 6 - 15) + 10)
    # Corners 0 and 1 of a cell, by axis. What corners have in common is done once.
    weights, away = (1 - fade, fade), (t, t - 1)
    total = np.zeros(x.shape[1], np.float32)
    numbers, directions = tables()
    for i in (0, 1):
        of_x = numbers.take(whole[0] + i) + whole[1]
        for j in (0, 1):
            of_xy = numbers.take(of_x + j) + whole[2]
            weight = weights[i][0] * weights[j][1]
            for k in (0, 1):
                corner = of_xy + k
                # One of the three is 0, so no order of the sum rounds otherwise.
                slope = directions[0].take(corner) * away[i][0]
                slope += directions[1].take(corner) * away[j][1]
                slope += directions[2].take(corner) * away[k][2]
                total += weight * weights[k][2] * slope
    return total


@dataclass(frozen=True)
class PerlinNoise:
    """Grey values of noise at places that the corners of triangles carry.

    ``conversion``: "linear" for (noise + 1) / 2, "absolute" for |noise|
    """

    conversion: str

    def __call__(self, barycentric: Floats32, corners: Floats32) -> Floats32:
        """See ``ColorAt``."""
        grey = self.grey(between(barycentric, corners))
        return np.broadcast_to(grey, (3, len(grey))).astype(np.float32)

    def grey(self, place: Floats32) -> Floats32:
        """Values (n,) from 0 to 1 at places (3, n)."""
        value = noise(place)
        grey = np.abs(value) if self.conversion == ABSOLUTE else (value + 1) / 2
        return np.asarray(np.clip(grey, 0, 1), np.float32)


def between(barycentric: Floats32, corners: Floats32) -> Floats32:
    """Places (3, n) by barycentrics (3, n) between what the corners carry (3 corners, 3, n)."""
    place: Floats32 = (barycentric[:, None] * corners).sum(axis=0, dtype=np.float32)
    return place
