"""Loops over packets of 16 rays, compiled by Numba; imported by ``course.geometry.packets`` alone, when they are used.

They are compiled when this module is first imported on a machine, and kept on disk from then on.

Layout of a packet (Embree 4's rtcore_ray.h): rows of 16 floats or integers, origin, tnear, direction, time, tfar, mask,
id, flags; then of the hit Ng, u, v, primID, geomID, instID.
"""

from __future__ import annotations

import numpy as np
from numba import njit, types

from course.geometry.kernels import COLUMNS, OPTIONS, ROW

WIDTH = 16
_TFAR, _MASK, _ID, _FLAGS = 8, 9, 10, 11
_RAY_ROWS = 12
_U, _V, _PRIMITIVE, _GEOMETRY = 15, 16, 17, 18
# Hits end with the instances' numbers, one row or two by how Embree was built; more room does no harm.
_ALL_ROWS = 24

_query = types.void(*[types.uintp] * 4)
_intersect16 = types.ExternalFunction("rtcIntersect16", _query)
_occluded16 = types.ExternalFunction("rtcOccluded16", _query)


@njit(**OPTIONS)
def _aligned(rows):
    """Memory for rows of 16 floats at an address that 64 divides, as Embree wants it."""
    memory = np.empty((rows + 1) * WIDTH, np.float32)
    start = (-memory.ctypes.data & 63) // 4
    return memory[start : start + rows * WIDTH].reshape(rows, WIDTH)


@njit(**OPTIONS)
def _fill(packet, whole, origin, direction, first, count):
    """Copy rays into a packet; ``whole`` is the same memory as integers."""
    shared = origin.shape[1] == 1
    for i in range(count):
        j = first + i
        k = 0 if shared else j
        for axis in range(3):
            packet[axis, i] = origin[axis, k]
            packet[4 + axis, i] = direction[axis, j]
        packet[3, i] = 0
        packet[7, i] = 0
        whole[_MASK, i] = -1
        whole[_ID, i] = 0
        whole[_FLAGS, i] = 0


@njit(**OPTIONS)
def _arguments(hint):
    """RTCIntersectArguments: flags, features (all of them), then context and callbacks (none)."""
    arguments = np.zeros(16, np.uint32)
    arguments[0] = hint
    arguments[1] = 0xFFFFFFFF
    return arguments


@njit(
    types.void(
        types.uintp,
        COLUMNS,
        COLUMNS,
        ROW,
        types.int64,
        types.int32[::1],
        COLUMNS,
    ),
    **OPTIONS,
)
def intersect(scene, origin, direction, limit, hint, triangle, uvt):
    """Nearest hits into ``triangle`` (N,) and ``uvt`` (3, N); see ``PacketScene.intersect``."""
    n = direction.shape[1]
    packet = _aligned(_ALL_ROWS)
    whole = packet.view(np.int32)
    valid = _aligned(1).view(np.int32)
    valid[:] = -1
    arguments = _arguments(hint)
    for first in range(0, n, WIDTH):
        count = min(WIDTH, n - first)
        valid[0, count:] = 0
        _fill(packet, whole, origin, direction, first, count)
        for i in range(count):
            packet[_TFAR, i] = limit[0] if len(limit) == 1 else limit[first + i]
            whole[_GEOMETRY, i] = -1
        _intersect16(valid.ctypes.data, scene, packet.ctypes.data, arguments.ctypes.data)
        for i in range(count):
            j = first + i
            hit = whole[_GEOMETRY, i] >= 0
            triangle[j] = whole[_PRIMITIVE, i] if hit else -1
            uvt[0, j] = packet[_U, i] if hit else 0
            uvt[1, j] = packet[_V, i] if hit else 0
            uvt[2, j] = packet[_TFAR, i]


@njit(types.void(types.uintp, COLUMNS, COLUMNS, types.float32, types.boolean[::1]), **OPTIONS)
def unoccluded(scene, origin, direction, limit, free):
    """Whether the ways are free, into ``free`` (N,); see ``PacketScene.unoccluded``."""
    n = direction.shape[1]
    packet = _aligned(_RAY_ROWS)
    whole = packet.view(np.int32)
    valid = _aligned(1).view(np.int32)
    valid[:] = -1
    arguments = _arguments(0)
    for first in range(0, n, WIDTH):
        count = min(WIDTH, n - first)
        valid[0, count:] = 0
        _fill(packet, whole, origin, direction, first, count)
        for i in range(count):
            packet[_TFAR, i] = limit
        _occluded16(valid.ctypes.data, scene, packet.ctypes.data, arguments.ctypes.data)
        # Embree sets tfar to minus infinity where something is in the way.
        for i in range(count):
            free[first + i] = packet[_TFAR, i] >= 0


_CHUNK = 256
_LESS, _MORE = np.float32(1 - 1e-6), np.float32(1 + 1e-6)


@njit(
    types.int64(COLUMNS, COLUMNS, ROW, COLUMNS, types.int64[::1]),
    **OPTIONS,
)
def entering(origin, direction, limit, box, which):
    """Which rays may meet a box, into the first places of ``which`` (N,), and how many; see ``PacketScene.entering``.

    By slabs: a ray is inside the box between the last of the three planes that it enters through and the first of
    those that it leaves through. Comparisons with the NaN of 0 / 0, of a ray within a plane, are false and say "maybe".
    """
    n = direction.shape[1]
    met = np.empty(_CHUNK, np.bool_)
    found = 0
    for first in range(0, n, _CHUNK):
        count = min(_CHUNK, n - first)
        for i in range(count):
            j = first + i
            near = np.float32(0)
            far = limit[0] if len(limit) == 1 else limit[j]
            for axis in range(3):
                inverse = np.float32(1) / direction[axis, j]
                a = (box[0, axis] - origin[axis, j]) * inverse
                b = (box[1, axis] - origin[axis, j]) * inverse
                low = a if a < b else b
                high = b if a < b else a
                near = low if low > near else near
                far = high if high < far else far
            met[i] = not near * _LESS > far * _MORE
        for i in range(count):
            which[found] = first + i
            found += met[i]
    return found
