"""Perlin's noise at one place, compiled by Numba; see ``course.engine.terms.surfaces.perlin``."""

import numpy as np

from course.engine.loops.options import APART, LEAN, njit
from course.engine.terms.surfaces.perlin import PERIOD, tables

_NOTHING, _HALF, _ONE = np.float32(0), np.float32(0.5), np.float32(1)
_SIX, _TEN, _FIFTEEN, _PERIOD = (np.float32(number) for number in (6, 10, 15, PERIOD))
_NUMBERS, _DIRECTIONS = tables()


@njit(**LEAN)
def _cell(x):
    """Remainder of the cell of a coordinate, how far behind the cell's beginning it is, and how faded."""
    cell = np.floor(x)
    t = x - cell
    rest = cell - np.floor(cell / _PERIOD) * _PERIOD
    # Places that are no numbers take some cell.
    whole = np.int64(rest) if _NOTHING <= rest < _PERIOD else np.int64(0)
    return np.uint64(whole), t, t * t * t * (t * (t * _SIX - _FIFTEEN) + _TEN)


@njit(**APART)
def noise(x, y, z):
    """See ``perlin.noise``."""
    cell_x, tx, fade_x = _cell(x)
    cell_y, ty, fade_y = _cell(y)
    cell_z, tz, fade_z = _cell(z)
    total = _NOTHING
    for i in range(2):
        away_x, weight_x = (tx - _ONE, fade_x) if i else (tx, _ONE - fade_x)
        of_x = np.uint64(_NUMBERS[cell_x + np.uint64(i)]) + cell_y
        for j in range(2):
            away_y, weight_y = (ty - _ONE, fade_y) if j else (ty, _ONE - fade_y)
            of_xy = np.uint64(_NUMBERS[of_x + np.uint64(j)]) + cell_z
            weight = weight_x * weight_y
            for k in range(2):
                away_z, weight_z = (tz - _ONE, fade_z) if k else (tz, _ONE - fade_z)
                corner = of_xy + np.uint64(k)
                slope = _DIRECTIONS[0, corner] * away_x
                slope += _DIRECTIONS[1, corner] * away_y
                slope += _DIRECTIONS[2, corner] * away_z
                total += weight * weight_z * slope
    return total


@njit(**LEAN)
def grey(absolute, x, y, z):
    """See ``PerlinNoise.grey``."""
    value = noise(x, y, z)
    value = abs(value) if absolute else (value + _ONE) * _HALF
    return min(max(value, _NOTHING), _ONE)
