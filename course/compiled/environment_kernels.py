"""Looking up a cube map, compiled by Numba; imported by ``course.compiled.environment``, when it is used."""

from __future__ import annotations

import numpy as np
from numba import njit, types

from course.compiled.options import COLUMNS, OPTIONS

_NOTHING, _HALF, _ONE = np.float32(0), np.float32(0.5), np.float32(1)


@njit(
    types.int64(types.float32[:, :, :, ::1], COLUMNS, types.boolean, COLUMNS, types.int64[::1]),
    **OPTIONS,
)
def lookup(faces, direction, seamless, radiance, across):
    """Fill ``radiance`` (3, n) as the course's ``cube_map.lookup`` does.

    Parameters
    ----------
    faces : (6, S, S, 3)
    direction : (3, n)
    seamless : whether directions within half a texel of a face's edge are left to ``lookup_seamless``
    across : (n,) filled from the beginning with these; their radiance is not filled

    Returns
    -------
    how many they are
    """
    found = 0
    side = np.float32(faces.shape[1])
    last = np.float32(faces.shape[1] - 1)
    for k in range(direction.shape[1]):
        x, y, z = direction[0, k], direction[1, k], direction[2, k]
        if abs(x) >= abs(y) and abs(x) >= abs(z):
            m, face = x, 0
            s, t = -z / m, -y / abs(m)
        elif abs(y) >= abs(z):
            m, face = y, 2
            s, t = x / abs(m), z / m
        else:
            m, face = z, 4
            s, t = x / m, -y / abs(m)
        face += m < 0
        column, row = (_HALF * s + _HALF) * side - _HALF, (_HALF * t + _HALF) * side - _HALF
        if seamless and (min(column, row) < 0 or max(column, row) > last):
            across[found] = k
            found += 1
            continue
        column, row = min(max(column, _NOTHING), last), min(max(row, _NOTHING), last)
        i, j = int(column), int(row)
        a, b = column - np.float32(i), row - np.float32(j)
        right, down = i + (column < last), j + (row < last)
        top_left, top_right = (_ONE - a) * (_ONE - b), a * (_ONE - b)
        low_left, low_right = (_ONE - a) * b, a * b
        for c in range(3):
            radiance[c, k] = (
                faces[face, j, i, c] * top_left
                + faces[face, j, right, c] * top_right
                + faces[face, down, i, c] * low_left
                + faces[face, down, right, c] * low_right
            )
    return found
