"""Looking up a cube map, compiled by Numba; imported by ``course.compiled.environment``, when it is used."""

import numpy as np
from numba import njit, types

from course.compiled.cube_kernels import bilinear, on_face
from course.compiled.options import COLUMNS, OPTIONS


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
        face, column, row = on_face(direction[0, k], direction[1, k], direction[2, k], side)
        if seamless and (min(column, row) < 0 or max(column, row) > last):
            across[found] = k
            found += 1
            continue
        for c in range(3):
            radiance[c, k] = bilinear(faces, face, column, row, c)
    return found
