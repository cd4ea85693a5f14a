"""Loops over rays and boxes, compiled by Numba; imported where they are used, and only then."""

import numpy as np
from numba import njit, types

from course.compiled.options import COLUMNS, OBJECTS, OPTIONS, ROW

_CHUNK = 256
"""Rays that are held against a box together."""

_LESS, _MORE = np.float32(1 - 1e-6), np.float32(1 + 1e-6)


@njit(**OPTIONS)
def _prepare(direction, limit, first, count, inverse, farthest):
    """1 / direction and the limits of ``count`` rays from ``first`` on, into (3, _CHUNK) and (_CHUNK,)."""
    for axis in range(3):
        way, over = direction[axis][first : first + count], inverse[axis]
        for i in range(count):
            over[i] = np.float32(1) / way[i]
    if len(limit) == 1:
        farthest[:count] = limit[0]
    else:
        farthest[:count] = limit[first : first + count]


@njit(**OPTIONS)
def _may_meet(origin, inverse, farthest, box, first, count, met):
    """Which of ``count`` rays from ``first`` on may meet a box (2, 3), into ``met``.

    By slabs: a ray is inside the box between the last of the three planes that it enters through and the first of
    those that it leaves through. Comparisons with the NaN of 0 / 0, of a ray within a plane, are false and say "maybe".

    Without branches and with rows of their own for each axis, so that many rays are compiled to one instruction.
    """
    x, y, z = (
        origin[0][first : first + count],
        origin[1][first : first + count],
        origin[2][first : first + count],
    )
    over_x, over_y, over_z = inverse[0], inverse[1], inverse[2]
    x0, y0, z0, x1, y1, z1 = box[0, 0], box[0, 1], box[0, 2], box[1, 0], box[1, 1], box[1, 2]
    for i in range(count):
        near, far = np.float32(0), farthest[i]
        a, b = (x0 - x[i]) * over_x[i], (x1 - x[i]) * over_x[i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        a, b = (y0 - y[i]) * over_y[i], (y1 - y[i]) * over_y[i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        a, b = (z0 - z[i]) * over_z[i], (z1 - z[i]) * over_z[i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        met[i] = not near * _LESS > far * _MORE


@njit(types.int64(COLUMNS, COLUMNS, ROW, COLUMNS, types.int64[::1]), **OPTIONS)
def entering(origin, direction, limit, box, which):
    """Which rays may meet a box, into the first places of ``which`` (N,), and how many.

    See ``PacketScene.entering``.
    """
    n = direction.shape[1]
    inverse, farthest = np.empty((3, _CHUNK), np.float32), np.empty(_CHUNK, np.float32)
    met = np.empty(_CHUNK, np.bool_)
    found = 0
    for first in range(0, n, _CHUNK):
        count = min(_CHUNK, n - first)
        _prepare(direction, limit, first, count, inverse, farthest)
        _may_meet(origin, inverse, farthest, box, first, count, met)
        for i in range(count):
            which[found] = first + i
            found += met[i]
    return found


@njit(types.int64(COLUMNS, COLUMNS, ROW, OBJECTS, COLUMNS, types.int64[::1]), **OPTIONS)
def remaining(origin, direction, limit, left, boxes, which):
    """Which rays may meet anything, into the first places of ``which`` (N,), and how many.

    Those that leave no convex object may; the others, if they may meet the box of another object.

    Parameters
    ----------
    origin, direction : (3, N)
    limit : (N,) or (1,)
    left : (N,) as ``hit_kernels.leave`` has it
    boxes : of ``ConvexObjects``
    """
    n = direction.shape[1]
    inverse, farthest = np.empty((3, _CHUNK), np.float32), np.empty(_CHUNK, np.float32)
    met, asked = np.empty(_CHUNK, np.bool_), np.empty(_CHUNK, np.bool_)
    found = 0
    for first in range(0, n, _CHUNK):
        count = min(_CHUNK, n - first)
        mine = left[first : first + count]
        waiting = 0
        for i in range(count):
            asked[i] = mine[i] < 0
            waiting += not asked[i]
        if waiting:
            _prepare(direction, limit, first, count, inverse, farthest)
            for k in range(boxes.shape[0] // 2):
                box = boxes[2 * k : 2 * k + 2]
                _may_meet(origin, inverse, farthest, box, first, count, met)
                for i in range(count):
                    asked[i] |= met[i] & (mine[i] != k)
        for i in range(count):
            which[found] = first + i
            found += asked[i]
    return found
