"""Steps through grids of densities: as many as it takes, by numbers that follow from the ray itself.

A flight takes a number of steps that nobody knows before, and a sampler has its numbers by dimension. So each ray makes
numbers of its own from the bits of its origin and direction, which chance has drawn, and the picture is the same in any
order of tiles.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.base.errors import EffectError
from course.engine.core.types import Floats32, Functions, Mask

STEPS = 8
"""Of all rays at a time."""

MOST_NUMBERS = 2_000_000
"""Of one ray: who needs more gets no farther."""

_MIX = tuple(map(np.uint64, (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB)))
"""Constants of splitmix64: G. Steele et al., "Fast splittable pseudorandom number generators", 2014."""


def _mixed(words: NDArray[np.uint64]) -> NDArray[np.uint64]:
    words = (words ^ (words >> np.uint64(30))) * _MIX[1]
    words = (words ^ (words >> np.uint64(27))) * _MIX[2]
    return np.asarray(words ^ (words >> np.uint64(31)))


def states(origin: Floats32, direction: Floats32, salt: int) -> NDArray[np.uint64]:
    """A state (n,) for each ray; rays that differ in a bit have others, and so have other salts."""
    found = np.full(direction.shape[1], np.uint64(salt))
    for row in (*origin, *direction):
        bits = np.ascontiguousarray(np.broadcast_to(row, found.shape), np.float32).view(np.uint32)
        found = _mixed((found + bits) * _MIX[0] + _MIX[2])
    return found


def numbers(state: NDArray[np.uint64], first: int, rows: int) -> Floats32:
    """Numbers (rows, n) in [0, 1) of 24 bits: those from ``first`` on that states make."""
    steps = np.arange(first + 1, first + rows + 1, dtype=np.uint64)[:, None]
    words = _mixed(state + steps * _MIX[0]) >> np.uint64(40)
    return words.astype(np.float32) * np.float32(2.0**-24)


def _check_end(function: str, taken: int) -> None:
    if taken > MOST_NUMBERS:
        raise EffectError(
            f"media.{function} comes to no end: after {taken:,} numbers a ray has neither been stopped nor come to its"
            " limit; each step must go on by -log(1 - u) / majorant"
        )


@dataclass(frozen=True)
class DensityGrid:
    """Densities in the unit cube.

    Attributes
    ----------
    density : (X, Y, Z) float32 [1 / unit of the compiled scene]
    majorant : the largest of them, above 0
    media : functions of the module
    """

    density: Floats32
    majorant: float
    media: Functions

    def flights(
        self, origin: Floats32, direction: Floats32, limit: Floats32
    ) -> tuple[Floats32, Mask]:
        """Distances (n,) of flights, and which of them the medium stops, up to limits (n,).

        ``direction``: (3, n), what a ray goes in the cube for a distance of 1
        """
        state = states(origin, direction, 1)
        distance, collided = np.zeros_like(limit), np.zeros(len(limit), np.bool_)
        going, taken = np.flatnonzero(limit > 0), 0
        while len(going):
            _check_end("delta_tracking", taken)
            way, start = direction.take(going, axis=1), distance.take(going)
            u = numbers(state.take(going), taken, 2 * STEPS).reshape(2, STEPS, -1)
            at = origin.take(going, axis=1) + start * way
            arrays = at, way, limit.take(going) - start, u
            gone, stopped = self.media.delta_tracking(self.density, self.majorant, *arrays)
            distance[going] = start + gone
            collided[going] = stopped
            # What came to its limit has gone all that was left.
            going = going[~stopped & (gone < arrays[2])]
            taken += 2 * STEPS
        return distance, collided

    def transmittance(self, origin: Floats32, direction: Floats32, limit: Floats32) -> Floats32:
        """An estimate (n,) of the share that comes through up to limits (n,); rays as in ``flights``."""
        state = states(origin, direction, 2)
        share, distance = np.ones_like(limit), np.zeros_like(limit)
        going, taken = np.flatnonzero(limit > 0), 0
        while len(going):
            _check_end("ratio_tracking", taken)
            way, start = direction.take(going, axis=1), distance.take(going)
            u = numbers(state.take(going), taken, STEPS)
            at = origin.take(going, axis=1) + start * way
            arrays = at, way, limit.take(going) - start, u
            left, gone = self.media.ratio_tracking(self.density, self.majorant, *arrays)
            share[going] *= left
            distance[going] = start + gone
            going = going[(gone < arrays[2]) & (share.take(going) > 0)]
            taken += STEPS
        return share

    def at(self, points: Floats32) -> Floats32:
        """Densities (n,) at points (3, n) of the cube, trilinear between the middles of cells."""
        size = np.array(self.density.shape)[:, None]
        place = np.clip(points.astype(np.float64) * size - 0.5, 0, size - 1)
        low = np.minimum(place.astype(np.intp), np.maximum(size - 2, 0))
        high, part = np.minimum(low + 1, size - 1), place - low
        found = np.zeros(points.shape[1])
        for corner in np.ndindex(2, 2, 2):
            upper = np.array(corner)[:, None] == 1
            share = np.where(upper, part, 1 - part).prod(axis=0)
            found += share * self.density[tuple(np.where(upper, high, low))]
        return found.astype(np.float32)
