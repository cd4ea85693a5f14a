"""Loops over packets of 16 rays, compiled by Numba; imported by ``course.compiled.packets``, when they are used.

They are compiled when this module is first imported on a machine, and kept on disk from then on.
"""

import numpy as np
from numba import njit, types

from course.compiled.options import COLUMNS, OPTIONS, ROW
from course.compiled.packet_kernels import aligned, arguments_of, intersect16, occluded16
from course.compiled.packets import ALL_ROWS, WIDTH

_TNEAR, _TIME, _TFAR, _MASK, _ID, _FLAGS = 3, 7, 8, 9, 10, 11
_U, _V, _PRIMITIVE, _GEOMETRY = 15, 16, 17, 18


@njit(**OPTIONS)
def _begin(packet, whole, origin):
    """What all rays have in common; ``whole`` is the same memory as integers. Embree leaves it as it is."""
    packet[_TNEAR], packet[_TIME] = 0, 0
    whole[_MASK], whole[_ID], whole[_FLAGS] = -1, 0, 0
    if origin.shape[1] == 1:
        for axis in range(3):
            packet[axis] = origin[axis, 0]


@njit(**OPTIONS)
def _fill(packet, origin, direction, first, count):
    """Copy rays that follow each other into a packet."""
    if origin.shape[1] == 1:
        for i in range(count):
            for axis in range(3):
                packet[4 + axis, i] = direction[axis, first + i]
        return
    for i in range(count):
        for axis in range(3):
            packet[axis, i] = origin[axis, first + i]
            packet[4 + axis, i] = direction[axis, first + i]


@njit(**OPTIONS)
def _gather(packet, origin, direction, which):
    """Copy some of the rays into a packet."""
    for i in range(len(which)):
        j = which[i]
        for axis in range(3):
            if origin.shape[1] > 1:
                packet[axis, i] = origin[axis, j]
            packet[4 + axis, i] = direction[axis, j]


@njit(**OPTIONS)
def _found(packet, whole, i, triangle, uvt, j):
    """What a packet's ray i, of all rays the j-th, has hit."""
    hit = whole[_GEOMETRY, i] >= 0
    triangle[j] = whole[_PRIMITIVE, i] if hit else -1
    uvt[0, j] = packet[_U, i] if hit else 0
    uvt[1, j] = packet[_V, i] if hit else 0
    uvt[2, j] = packet[_TFAR, i]


@njit(
    types.void(
        *(types.uintp, COLUMNS, COLUMNS, ROW, types.int64[::1]),
        *(types.boolean, types.int64, types.int32[::1], COLUMNS),
    ),
    **OPTIONS,
)
def intersect(scene, origin, direction, limit, which, every, hint, triangle, uvt):
    """Nearest hits into ``triangle`` (N,) and ``uvt`` (3, N); see ``PacketScene.intersect``.

    ``which``: (n,) the rays that are asked, in ascending order; of no meaning where ``every`` one is
    """
    n = direction.shape[1] if every else len(which)
    packet = aligned(ALL_ROWS)
    whole = packet.view(np.int32)
    _begin(packet, whole, origin)
    valid = aligned(1).view(np.int32)
    valid[:] = -1
    arguments = arguments_of(hint)
    if not every:
        triangle[:] = -1
        uvt[:2] = 0
        if len(limit) == 1:
            uvt[2] = limit[0]
        else:
            uvt[2] = limit
    for first in range(0, n, WIDTH):
        count = min(WIDTH, n - first)
        valid[0, count:] = 0
        # Two loops and not one with a question in it: that would be a twentieth of the time of rays that hit nothing.
        if every:
            _fill(packet, origin, direction, first, count)
            for i in range(count):
                packet[_TFAR, i] = limit[0] if len(limit) == 1 else limit[first + i]
                whole[_GEOMETRY, i] = -1
        else:
            _gather(packet, origin, direction, which[first : first + count])
            for i in range(count):
                packet[_TFAR, i] = limit[0] if len(limit) == 1 else limit[which[first + i]]
                whole[_GEOMETRY, i] = -1
        intersect16(valid.ctypes.data, scene, packet.ctypes.data, arguments.ctypes.data)
        if every:
            for i in range(count):
                _found(packet, whole, i, triangle, uvt, first + i)
        else:
            for i in range(count):
                _found(packet, whole, i, triangle, uvt, which[first + i])


@njit(types.void(types.uintp, COLUMNS, COLUMNS, types.float32, types.boolean[::1]), **OPTIONS)
def unoccluded(scene, origin, direction, limit, free):
    """Whether the ways are free, into ``free`` (N,); see ``PacketScene.unoccluded``."""
    n = direction.shape[1]
    packet = aligned(ALL_ROWS)
    whole = packet.view(np.int32)
    _begin(packet, whole, origin)
    valid = aligned(1).view(np.int32)
    valid[:] = -1
    arguments = arguments_of(0)
    for first in range(0, n, WIDTH):
        count = min(WIDTH, n - first)
        valid[0, count:] = 0
        _fill(packet, origin, direction, first, count)
        for i in range(count):
            packet[_TFAR, i] = limit
        occluded16(valid.ctypes.data, scene, packet.ctypes.data, arguments.ctypes.data)
        # Embree sets tfar to minus infinity where something is in the way.
        for i in range(count):
            free[first + i] = packet[_TFAR, i] >= 0
