"""Shadow rays of a packet among triangles of which some move, compiled by Numba; see ``packet_kernels`` for the layout.

Each mover has a scene of its own. A packet asks first what stands still, and then each mover whose box one of its rays
may meet, from origins that are shifted into the mover's frame.
"""

import numpy as np
from numba import types

from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import TFAR, TO, WIDTH, occluded

# Rows of our own behind those of the packet: origins that are not shifted, 1 / direction, time.
_ORIGIN, _INVERSE, _TIME = 24 * WIDTH, 27 * WIDTH, 30 * WIDTH
ROWS = 31
_X, _Y, _Z = 0, WIDTH, 2 * WIDTH
_ONE, _NOTHING = np.float32(1), np.float32(0)
_LESS, _MORE = np.float32(1 - 1e-6), np.float32(1 + 1e-6)

SCENES = types.uintp[::1]
"""What stands still, then each mover; 0 for no triangles."""
BOXES = types.float32[:, :, ::1]
"""(K, 2, 3) of the movers, as ``roomy_box`` makes them."""


@njit(**LEAN)
def keep(s, time, first, count):
    """Keep a packet's origins before they are shifted, with its times and 1 / direction."""
    for i in range(3 * WIDTH):
        s[_ORIGIN + i] = s[i]
        s[_INVERSE + i] = _ONE / s[TO + i]
    for i in range(count):
        s[_TIME + i] = time[first + i]


@njit(**LEAN)
def shift(s, velocity, box, asked, valid):
    """Shift a packet's origins into a mover's frame, and fill which of the rays that are asked may meet its box.

    The slabs are those of ``roomy_box``. Returns how many may meet it.
    """
    for c in range(3):
        for i in range(WIDTH):
            s[c * WIDTH + i] = s[_ORIGIN + c * WIDTH + i] - velocity[c] * s[_TIME + i]
    x0, y0, z0, x1, y1, z1 = box[0, 0], box[0, 1], box[0, 2], box[1, 0], box[1, 1], box[1, 2]
    count = 0
    for i in range(WIDTH):
        near, far = _NOTHING, s[TFAR + i]
        a = (x0 - s[_X + i]) * s[_INVERSE + _X + i]
        b = (x1 - s[_X + i]) * s[_INVERSE + _X + i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        a = (y0 - s[_Y + i]) * s[_INVERSE + _Y + i]
        b = (y1 - s[_Y + i]) * s[_INVERSE + _Y + i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        a = (z0 - s[_Z + i]) * s[_INVERSE + _Z + i]
        b = (z1 - s[_Z + i]) * s[_INVERSE + _Z + i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        meets = (asked[i] != 0) & (s[TFAR + i] >= 0) & (not near * _LESS > far * _MORE)
        valid[i] = -1 if meets else 0
        count += meets
    return count


@njit(**LEAN)
def unshift(s):
    """Put a packet's origins back to where ``keep`` has seen them."""
    for i in range(3 * WIDTH):
        s[i] = s[_ORIGIN + i]


@njit(**LEAN)
def occlude(scenes, velocity, boxes, time, first, count, s, asked, valid, arguments):
    """Set ``tfar`` of the rays that are asked to minus infinity where something is in the way.

    Parameters
    ----------
    scenes, velocity, boxes : (1 + K,), (K, 3) and (K, 2, 3)
    time : (n,) of all rays, of which the packet's ``count`` begin at ``first``; (0,) without movers
    s : the packet, with ROWS rows; its origins are not what they were where something moves
    asked, valid : (16,) int32, -1 for the rays that are asked; the second is overwritten
    """
    if scenes[0]:
        occluded(asked.ctypes.data, scenes[0], s.ctypes.data, arguments.ctypes.data)
    if len(velocity):
        keep(s, time, first, count)
        for k in range(len(velocity)):
            if shift(s, velocity[k], boxes[k], asked, valid):
                occluded(valid.ctypes.data, scenes[1 + k], s.ctypes.data, arguments.ctypes.data)
