"""Queries among triangles of which some move, compiled by Numba; imported where something does."""

import numpy as np
from numba import njit, types

from course.compiled.occlusion_kernels import BOXES, ROWS, SCENES, keep, occlude, shift
from course.compiled.options import COLUMNS, OPTIONS, ROW
from course.compiled.packet_kernels import (
    GEOMETRY,
    PRIMITIVE,
    TFAR,
    TO,
    WIDTH,
    U,
    V,
    aligned,
    arguments_of,
    begin,
    intersect16,
)

_NOTHING = np.float32(0)


@njit(**OPTIONS)
def _fill(s, origin, direction, first, count):
    for c in range(3):
        if origin.shape[1] == 1:
            for i in range(WIDTH):
                s[c * WIDTH + i] = origin[c, 0]
        else:
            for i in range(count):
                s[c * WIDTH + i] = origin[c, first + i]
        for i in range(count):
            s[TO + c * WIDTH + i] = direction[c, first + i]


@njit(
    types.void(
        *(SCENES, COLUMNS, BOXES, types.int64[::1], COLUMNS, COLUMNS, ROW),
        *(types.int64, types.float32, types.int32[::1], COLUMNS),
    ),
    **OPTIONS,
)
def intersect(scenes, velocity, boxes, numbers, origin, direction, time, hint, far, triangle, uvt):
    """Nearest hits into ``triangle`` (N,) and ``uvt`` (3, N), as ``MovingAccelerator.intersect`` finds them.

    Parameters
    ----------
    scenes, velocity, boxes : (1 + K,), (K, 3) and (K, 2, 3)
    numbers : (1 + K,) the first triangle of each scene
    origin, direction, time : (3, N) or (3, 1), (3, N), (N,)
    far : t of what hits nothing
    """
    n = direction.shape[1]
    memory = aligned(ROWS + 2).reshape((ROWS + 2) * WIDTH)
    s, masks = memory[: ROWS * WIDTH], memory[ROWS * WIDTH :].view(np.int32)
    whole = s.view(np.int32)
    asked, valid = masks[:WIDTH], masks[WIDTH:]
    begin(s, whole)
    arguments = arguments_of(hint)
    for first in range(0, n, WIDTH):
        count = min(WIDTH, n - first)
        _fill(s, origin, direction, first, count)
        keep(s, time, first, count)
        for i in range(WIDTH):
            asked[i] = -1 if i < count else 0
            s[TFAR + i] = far
            whole[GEOMETRY + i] = -1
        for k in range(len(scenes)):
            if k:
                if not shift(s, velocity[k - 1], boxes[k - 1], asked, valid):
                    continue
                for i in range(WIDTH):
                    whole[GEOMETRY + i] = -1
                intersect16(valid.ctypes.data, scenes[k], s.ctypes.data, arguments.ctypes.data)
            elif scenes[0]:
                intersect16(asked.ctypes.data, scenes[0], s.ctypes.data, arguments.ctypes.data)
            for i in range(count):
                j = first + i
                hit = whole[GEOMETRY + i] >= 0
                if k == 0 or hit:
                    triangle[j] = whole[PRIMITIVE + i] + numbers[k] if hit else -1
                    uvt[0, j] = s[U + i] if hit else _NOTHING
                    uvt[1, j] = s[V + i] if hit else _NOTHING
                    uvt[2, j] = s[TFAR + i]


@njit(
    types.void(
        *(SCENES, COLUMNS, BOXES, COLUMNS, COLUMNS, ROW, types.float32),
        *(types.boolean[::1], types.boolean[::1]),
    ),
    **OPTIONS,
)
def unoccluded(scenes, velocity, boxes, origin, direction, time, limit, active, free):
    """Whether nothing lies between origin and origin + limit * direction, into ``free`` (N,).

    ``active`` (N,) are the rays that are asked, (0,) for all; the others are not free.
    """
    n = direction.shape[1]
    memory = aligned(ROWS + 2).reshape((ROWS + 2) * WIDTH)
    s, masks = memory[: ROWS * WIDTH], memory[ROWS * WIDTH :].view(np.int32)
    asked, valid = masks[:WIDTH], masks[WIDTH:]
    begin(s, s.view(np.int32))
    arguments = arguments_of(0)
    for first in range(0, n, WIDTH):
        count = min(WIDTH, n - first)
        _fill(s, origin, direction, first, count)
        for i in range(WIDTH):
            wanted = i < count and (len(active) == 0 or active[first + i])
            asked[i] = -1 if wanted else 0
            s[TFAR + i] = limit
        occlude(scenes, velocity, boxes, time, first, count, s, asked, valid, arguments)
        for i in range(count):
            free[first + i] = (asked[i] != 0) & (s[TFAR + i] >= 0)
