"""What shafts tell of shadow rays, compiled by Numba; a part of the fused loop.

It does what ``course.engine.terms.shafts`` does, but looks at one shaft at a time, and only until its first obstacles.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats32, Floats64, Indices, Numbers
from course.engine.loops.lanes import (
    ASKED,
    CUBE,
    KNOWN,
    NG,
    OFFSET,
    OWNER,
    SENT,
    SHADOW_TFAR,
    SHADOW_TO,
    SIDE,
    TIME,
    TRIANGLE,
    A,
    B,
    C,
    P,
)
from course.engine.loops.options import LEAN, OPTIONS, njit
from course.engine.loops.packet_kernels import WIDTH
from course.engine.terms.shafts.boxes import BRANCH, LEAF
from course.engine.terms.shafts.cells import FINEST
from course.engine.terms.shafts.stage import MULTIPLIER, PROBES
from course.engine.terms.shafts.walk import (
    AROUND,
    CLEAR,
    CORNERS,
    CUT_OFF,
    LEAVE,
    MIXED,
    MOST,
    ORDER,
    OWN,
    PLANES,
    STEEPEST,
    TURNS,
)

_Y, _Z = WIDTH, 2 * WIDTH
_TWO, _ONE = np.float32(2), np.float32(1)
_MANTISSA, _BIAS = np.int32(23), np.int32(127)
_BITS, _TWICE, _LAST = np.int32(FINEST), np.int32(2 * FINEST), np.int32((1 << FINEST) - 1)
_NONE, _ALL, _SIGN, _DEEP = np.int32(0), np.int32(-1), np.int32(31), np.int32(FINEST)
_MULTIPLIER, _SHIFT, _STATE = np.uint64(MULTIPLIER), np.uint64(2), np.uint64(3)
_BESIDE, _BETWEEN = 1, 2

OBSTACLES = 4
"""Triangles in a shaft that are asked whether they cut it off, until it is given up."""

_DEEPEST = 16
"""Levels of boxes, at most: four times as many triangles for each of them."""

WALK = 4 * PLANES + 16
"""Numbers of a shaft: normals and heights of its planes, and both ends."""
_BEGIN, _HALF, _END, _AXIS = (4 * PLANES + 3 * k for k in range(4))
PILE = 4 * BRANCH * _DEEPEST
"""Boxes that wait, at most, and how many have been met at each level."""


class FusedShafts(NamedTuple):
    """``Tables``, array by array.

    Attributes
    ----------
    slot : (L,) row of each light, -1 for none; (0,) where there are no shafts
    lamps : (rows, 15) float64: middle, halves of edges, radius, limit, and 1 if it is far away
    shift : bits of a product by ``MULTIPLIER`` below those that tell a place
    moves : whether hits have a time
    """

    owner: Numbers
    low: Floats64
    high: Floats64
    plane: Floats64
    leave: Floats64
    first: Indices
    last: Indices
    eye: Floats32
    corner: Floats32
    size: Floats32
    corners: Floats32
    sweep: Floats32
    room: Floats32
    number: Numbers
    leaf: Numbers
    boxes: Floats32
    numbers: Numbers
    level: Indices
    slot: Indices
    lamps: Floats64
    known: NDArray[np.uint64]
    shift: np.uint64
    moves: bool


@njit(**LEAN)
def find_cells(shafts, s, whole):
    """The cells of the hits, see ``keys_of``: CUBE has level and two coordinates, OWNER owner and the third one."""
    n, size, across = s.view(np.int32), shafts.size[1], shafts.size[0]
    eye_x, eye_y, eye_z = shafts.eye[0], shafts.eye[1], shafts.eye[2]
    x0, y0, z0 = shafts.corner[0], shafts.corner[1], shafts.corner[2]
    for i in range(WIDTH):
        side = np.int64(0) if s[SIDE + i] > 0 else np.int64(1)
        n[OWNER + i] = shafts.owner[np.uint64(whole[TRIANGLE + i]), side] << _BITS
    for i in range(WIDTH):
        x, y, z = s[P + i] - eye_x, s[P + _Y + i] - eye_y, s[P + _Z + i] - eye_z
        s[A + i] = size / (x * x + y * y + z * z)
    for i in range(WIDTH):
        level = ((n[A + i] >> _MANTISSA) - _BIAS) >> np.int32(1)
        level = _NONE if level < _NONE else level
        level = _DEEP if level > _DEEP else level
        n[B + i], n[C + i] = (level + _BIAS) << _MANTISSA, level << _TWICE
    for i in range(WIDTH):
        x = np.int32((s[P + i] - x0) * across * s[B + i])
        y = np.int32((s[P + _Y + i] - y0) * across * s[B + i])
        z = np.int32((s[P + _Z + i] - z0) * across * s[B + i])
        n[CUBE + i] = n[C + i] | (x & _LAST) << _BITS | (y & _LAST)
        n[OWNER + i] = n[OWNER + i] | z & _LAST


@njit(**LEAN)
def spare(shafts, k, s, whole, scratch):
    """SENT are those of the rays in ASKED, towards light k, that must be sent; how many are clear, and are cut off.

    Rays are those from the hits to the light's points in SHADOW_TO; their SHADOW_TFAR is below 0 if they are cut off.
    """
    row, told, n = shafts.slot[k], scratch.told, s.view(np.int32)
    cube, owner = np.int32(told[row, 0]), np.int32(told[row, 1])
    for i in range(WIDTH):
        n[KNOWN + i] = whole[SENT + i] = whole[ASKED + i]
    for i in range(WIDTH):
        height = (
            s[NG + i] * s[SHADOW_TO + i]
            + s[NG + _Y + i] * s[SHADOW_TO + _Y + i]
            + s[NG + _Z + i] * s[SHADOW_TO + _Z + i]
        )
        high = _ALL if height > _TWO * s[OFFSET + i] else _NONE
        # An owner that is none is negative.
        n[KNOWN + i] = n[KNOWN + i] & high & ~(n[OWNER + i] >> _SIGN)
    if shafts.moves:
        for i in range(WIDTH):
            during = (s[TIME + i] >= 0) & (s[TIME + i] <= 1)
            n[KNOWN + i] = n[KNOWN + i] & (_ALL if during else _NONE)
    some = others = _NONE
    for i in range(WIDTH):
        some -= n[KNOWN + i]
        others |= ((n[CUBE + i] ^ cube) | (n[OWNER + i] ^ owner)) & n[KNOWN + i]
    clear = cut = np.int64(0)
    if some == 0:
        return clear, cut
    if others == 0:
        # Nearly all packets of camera rays, and of coherent ones.
        state = told[row, 2]
        if state == MIXED:
            return clear, cut
        for i in range(WIDTH):
            whole[SENT + i] &= ~n[KNOWN + i]
        if state == CLEAR:
            return np.int64(some), cut
        for i in range(WIDTH):
            # As Embree marks a ray that something is in the way of.
            s[SHADOW_TFAR + i] = -_ONE if n[KNOWN + i] else s[SHADOW_TFAR + i]
        return clear, np.int64(some)
    for i in range(WIDTH):
        if n[KNOWN + i] == 0:
            continue
        if n[CUBE + i] != told[row, 0] or n[OWNER + i] != told[row, 1]:
            told[row, 0], told[row, 1] = n[CUBE + i], n[OWNER + i]
            told[row, 2] = _look_up(shafts, row, n[CUBE + i], n[OWNER + i], scratch)
        state = told[row, 2]
        if state != MIXED:
            whole[SENT + i] = 0
        if state == CLEAR:
            clear += 1
        elif state == CUT_OFF:
            s[SHADOW_TFAR + i] = -_ONE
            cut += 1
    return clear, cut


@njit(**LEAN)
def _look_up(shafts, row, cube, owner, scratch):
    """What is known of a cell; it is looked at where nothing is known yet."""
    key = np.int64(owner >> _BITS) << (3 * FINEST + 4)
    key |= np.int64(np.uint32(cube)) << FINEST | np.int64(owner & _LAST)
    place = np.int64((np.uint64(key) * _MULTIPLIER) >> shafts.shift)
    last = shafts.known.shape[1] - 1
    for _ in range(PROBES):
        entry = shafts.known[row, place]
        if entry == 0:
            state = _shaft_state(shafts, row, key, scratch.walk, scratch.boxes)
            shafts.known[row, place] = np.uint64(key << 2 | state)
            return state
        if np.int64(entry >> _SHIFT) == key:
            return np.int64(entry & _STATE)
        place = (place + 1) & last
    return np.int64(MIXED)


@njit(**OPTIONS, _nrt=False)
def _shaft_state(shafts, row, key, walk, pile):
    """What the shaft of a cell to a light is; memory for it, of WALK and of PILE numbers."""
    owner = _make_shaft(shafts, row, key, walk)
    first, last = shafts.first[owner], shafts.last[owner]
    levels, obstacles = len(shafts.level) - 1, 0
    for level in range(levels):
        pile[PILE - 1 - level] = 0
    pile[0] = (levels - 1) << 32
    waiting = 1
    while waiting:
        waiting -= 1
        level, number = pile[waiting] >> 32, pile[waiting] & 0xFFFFFFFF
        box = shafts.level[level] + number
        if shafts.numbers[box, 0] >= first and shafts.numbers[box, 1] < last:
            continue
        if not _meets_box(shafts, box, walk):
            continue
        pile[PILE - 1 - level] += 1
        if pile[PILE - 1 - level] > MOST:
            return np.int64(MIXED)
        if level == 0:
            begin = LEAF * int(shafts.leaf[number])
            for t in range(begin, min(begin + LEAF, len(shafts.number))):
                if first <= shafts.number[t] < last or not _meets_triangle(shafts, t, walk):
                    continue
                lies = _lies(shafts, row, t, walk)
                if lies == _BETWEEN and _cuts(shafts, row, t, walk):
                    return np.int64(CUT_OFF)
                obstacles += lies != _BESIDE
                if obstacles == OBSTACLES:
                    return np.int64(MIXED)
            continue
        end = shafts.level[level] - shafts.level[level - 1]
        for child in range(BRANCH * number, min(BRANCH * (number + 1), end)):
            pile[waiting] = (level - 1) << 32 | child
            waiting += 1
    return np.int64(MIXED if obstacles else CLEAR)


@njit(**LEAN)
def _reach(lamp, x, y, z):
    """``reach_of`` one vector, but for the radius."""
    a = abs(lamp[3] * x + lamp[4] * y + lamp[5] * z)
    b = abs(lamp[6] * x + lamp[7] * y + lamp[8] * z)
    c = abs(lamp[9] * x + lamp[10] * y + lamp[11] * z)
    return a + b + c


@njit(**LEAN)
def _near(walk, x, y, z):
    return walk[_HALF] * abs(x) + walk[_HALF + 1] * abs(y) + walk[_HALF + 2] * abs(z)


@njit(**LEAN)
def _far(walk, lamp, x, y, z):
    return _near(walk, x, y, z) if lamp[14] > 0 else _reach(lamp, x, y, z) + lamp[12]


@njit(**LEAN)
def _along(walk, at, x, y, z):
    return walk[at] * x + walk[at + 1] * y + walk[at + 2] * z


@njit(**LEAN)
def _add_plane(walk, number, lamp, x, y, z):
    walk[4 * number], walk[4 * number + 1], walk[4 * number + 2] = x, y, z
    near = _along(walk, _BEGIN, x, y, z) + _near(walk, x, y, z)
    far = _along(walk, _END, x, y, z) + _far(walk, lamp, x, y, z)
    walk[4 * number + 3] = max(near, far)


@njit(**LEAN)
def _make_shaft(shafts, row, key, walk):
    """Planes and ends of a shaft; returns the owner of its cell."""
    lamp = shafts.lamps[row]
    code = key >> (4 + 3 * FINEST)
    owner = code >> 1
    width = 1 / (np.float64(shafts.size[0]) * np.float64(1 << (key >> 3 * FINEST & 15)))
    room, largest = shafts.leave[owner, 1], 0.0
    last = len(shafts.boxes) - 1
    for c in range(3):
        at = key >> FINEST * (2 - c) & ((1 << FINEST) - 1)
        begin = np.float64(shafts.corner[c]) + width * at
        low = max(begin - room, shafts.low[owner, c])
        high = min(begin + width + room, shafts.high[owner, c])
        walk[_BEGIN + c] = (low + high) / 2
        walk[_HALF + c] = (high - low) / 2
        for side in range(0, 6, 3):
            largest = max(largest, abs(np.float64(shafts.boxes[last, side + c])))
    for c in range(3):
        walk[_END + c] = walk[_BEGIN + c] + 6 * largest * lamp[c] if lamp[14] > 0 else lamp[c]
        walk[_AXIS + c] = walk[_END + c] - walk[_BEGIN + c]
    x, y, z = walk[_AXIS], walk[_AXIS + 1], walk[_AXIS + 2]
    length = np.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    sign = math.copysign(1.0, z)
    q = -1 / (sign + z)
    r = x * y * q
    for k in range(AROUND):
        cosine, sine = TURNS[k, 0], TURNS[k, 1]
        u = cosine * (1 + sign * x * x * q) + sine * r
        v = cosine * (sign * r) + sine * (sign + y * y * q)
        w = cosine * (-sign * x) + sine * -y
        nx, ny, nz = u, v, w
        for _ in range(2):
            slope = (_near(walk, nx, ny, nz) - _far(walk, lamp, nx, ny, nz)) / length
            slope = min(max(slope, -STEEPEST), STEEPEST)
            cosine = np.sqrt(1 - slope * slope)
            nx, ny, nz = cosine * u + slope * x, cosine * v + slope * y, cosine * w + slope * z
        _add_plane(walk, k, lamp, nx, ny, nz)
    _add_plane(walk, AROUND, lamp, x, y, z)
    _add_plane(walk, AROUND + 1, lamp, -x, -y, -z)
    sign = -1.0 if code & 1 else 1.0
    px, py, pz = (
        shafts.plane[owner, 0] * sign,
        shafts.plane[owner, 1] * sign,
        shafts.plane[owner, 2] * sign,
    )
    own, flat = 4 * OWN, px * px + py * py + pz * pz > 0
    walk[own], walk[own + 1], walk[own + 2] = -px, -py, -pz
    height = -shafts.plane[owner, 3] * sign - LEAVE * shafts.leave[owner, 0]
    walk[own + 3] = height if flat else np.inf
    return owner


@njit(**LEAN)
def _meets_box(shafts, box, walk):
    boxes = shafts.boxes
    x0, y0, z0 = np.float64(boxes[box, 0]), np.float64(boxes[box, 1]), np.float64(boxes[box, 2])
    x1, y1, z1 = np.float64(boxes[box, 3]), np.float64(boxes[box, 4]), np.float64(boxes[box, 5])
    x, y, z = (x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2
    a, b, c = (x1 - x0) / 2, (y1 - y0) / 2, (z1 - z0) / 2
    for number in ORDER:
        k = 4 * number
        nx, ny, nz = walk[k], walk[k + 1], walk[k + 2]
        least = nx * x + ny * y + nz * z - (abs(nx) * a + abs(ny) * b + abs(nz) * c)
        if least > walk[k + 3]:
            return False
    return True


@njit(**LEAN)
def _meets_triangle(shafts, t, walk):
    """False if one plane of the shaft has the triangle behind it."""
    p, room = shafts.corners[t], np.float64(shafts.room[t])
    for number in ORDER:
        k = 4 * number
        nx, ny, nz = walk[k], walk[k + 1], walk[k + 2]
        a = np.float64(p[0]) * nx + np.float64(p[1]) * ny + np.float64(p[2]) * nz
        b = np.float64(p[3]) * nx + np.float64(p[4]) * ny + np.float64(p[5]) * nz
        c = np.float64(p[6]) * nx + np.float64(p[7]) * ny + np.float64(p[8]) * nz
        least = min(a, b, c)
        if len(shafts.sweep):
            way = shafts.sweep[t]
            moved = np.float64(way[0]) * nx + np.float64(way[1]) * ny + np.float64(way[2]) * nz
            least += min(moved, 0.0)
        if least > walk[k + 3] + (0.5 * room if number == OWN else room):
            return False
    return True


@njit(**LEAN)
def _lies(shafts, row, t, walk):
    """_BESIDE if a triangle's plane has all of the shaft on one side, _BETWEEN if it lies between its ends, else 0."""
    lamp = shafts.lamps[row]
    p, room = shafts.corners[t], np.float64(shafts.room[t])
    x0, y0, z0 = np.float64(p[0]), np.float64(p[1]), np.float64(p[2])
    ax, ay, az = np.float64(p[3]) - x0, np.float64(p[4]) - y0, np.float64(p[5]) - z0
    bx, by, bz = np.float64(p[6]) - x0, np.float64(p[7]) - y0, np.float64(p[8]) - z0
    x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    length = np.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    moved = 0.0
    if len(shafts.sweep):
        way = shafts.sweep[t]
        moved = np.float64(way[0]) * x + np.float64(way[1]) * y + np.float64(way[2]) * z
    height = x0 * x + y0 * y + z0 * z
    least, most = height + min(moved, 0.0) - room, height + max(moved, 0.0) + room
    begin, end = _along(walk, _BEGIN, x, y, z), _along(walk, _END, x, y, z)
    near, far = _near(walk, x, y, z), _far(walk, lamp, x, y, z)
    limit = lamp[13]
    low, high = begin - near, begin + near
    low_end = limit * (end - far) + (1 - limit) * low
    high_end = limit * (end + far) + (1 - limit) * high
    if min(low, low_end) > most or max(high, high_end) < least:
        return _BESIDE
    if ((low > most and high_end < least) or (high < least and low_end > most)) and moved == 0:
        return _BETWEEN
    return 0


@njit(**LEAN)
def _turn(p, k, x, y, z):
    """The product of the vectors from a point to two corners."""
    j = 3 * ((k + 1) % 3)
    k = 3 * k
    ax, ay, az = np.float64(p[k]) - x, np.float64(p[k + 1]) - y, np.float64(p[k + 2]) - z
    bx, by, bz = np.float64(p[j]) - x, np.float64(p[j + 1]) - y, np.float64(p[j + 2]) - z
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@njit(**LEAN)
def _cuts(shafts, row, t, walk):
    """See ``_cut_off`` of ``shaft_walk``."""
    p, room, lamp = shafts.corners[t], np.float64(shafts.room[t]), shafts.lamps[row]
    x, y, z = walk[_BEGIN], walk[_BEGIN + 1], walk[_BEGIN + 2]
    dx, dy, dz = walk[_END] - x, walk[_END + 1] - y, walk[_END + 2] - z
    wide = walk[_HALF] + walk[_HALF + 1] + walk[_HALF + 2]
    longest = np.sqrt(dx * dx + dy * dy + dz * dz) + wide
    if lamp[14] > 0:
        longest += wide
    else:
        for c in range(3, 12):
            longest += abs(lamp[c])
        longest += lamp[12]
    left = right = True
    for k in range(3):
        j = (k + 1) % 3
        ex = np.float64(p[3 * j]) - np.float64(p[3 * k])
        ey = np.float64(p[3 * j + 1]) - np.float64(p[3 * k + 1])
        ez = np.float64(p[3 * j + 2]) - np.float64(p[3 * k + 2])
        least = 2 * room * np.sqrt(ex * ex + ey * ey + ez * ez) * longest
        for n in range(8):
            sx = x + walk[_HALF] * CORNERS[n, 0]
            sy = y + walk[_HALF + 1] * CORNERS[n, 1]
            sz = z + walk[_HALF + 2] * CORNERS[n, 2]
            u, v, w = _turn(p, k, sx, sy, sz)
            volume = u * (walk[_END] - sx) + v * (walk[_END + 1] - sy) + w * (walk[_END + 2] - sz)
            if lamp[14] > 0:
                reach = _near(walk, u, v, w)
            else:
                reach = _reach(lamp, u, v, w) + lamp[12] * np.sqrt(u * u + v * v + w * w)
            left = left and volume - reach > least
            right = right and volume + reach < -least
        if not (left or right):
            return False
    return True
