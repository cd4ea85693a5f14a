"""Sixteen rays at a time through a hierarchy, by loops that Numba compiles.

``intersect`` and ``occlude`` take the same arguments as Embree's ``rtcIntersect16`` and ``rtcOccluded16``, with the
address of a hierarchy (``build_kernels``) in the place of a scene, and fill in the same fields: tfar, u, v, primID and
geomID. Loops that call Embree by an address can call these.

A triangle is tested by Pluecker coordinates: the sign of a ray's product with an edge is the same for both triangles of
the edge, so no ray slips through between them. Where several triangles are hit at one and the same distance, the one
with the lowest number counts: what a ray hits does not depend on the rays beside it. Nothing is fused or reordered, so
the bits are the same on every processor, and those of ``course.engine.casters.batches``.
"""

import numpy as np
from llvmlite import ir
from numba import carray, cfunc, njit, types
from numba.core import cgutils
from numba.extending import intrinsic

from course.engine.casters.batches import EPSILON, LEAST, LESS, MORE, NEEDLE
from course.engine.casters.build_kernels import DEEPEST, TRIANGLE

WIDTH = 16
_ORIGINS, _DIRECTIONS, _LIMITS = 0, 4 * WIDTH, 8 * WIDTH
_US, _VS, _PRIMITIVES, _GEOMETRIES = (row * WIDTH for row in (15, 16, 17, 18))
_ROWS = 20

# Rows of our own.
_X, _Y, _Z = 0, WIDTH, 2 * WIDTH
(_O, _D, _INVERSE, _LIMIT, _U, _V, _TRIANGLE, _FIRST, _SECOND, _A, _B, _C, _STACK) = (
    row * WIDTH for row in (0, 3, 6, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18)
)
_PLACES = DEEPEST + 40
_SIZE = _STACK + _PLACES * (WIDTH + 1)

_NOTHING, _ONE, _TWO = np.float32(0), np.float32(1), np.float32(2)
_NEVER = np.float32(3e38)
_NOBODY = 0x7FFFFFFF

_OPTIONS = {"nogil": True, "cache": True, "error_model": "numpy"}
_PART = _OPTIONS | {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, "_nrt": False}
"""For what only other loops call; no array can be made there."""
_LEAN = _PART | {"forceinline": True}


@intrinsic
def _scratch(typing_context):  # noqa: ARG001
    """Address of memory on the stack, which 64 divides, for as long as the function runs."""

    def generate(context, builder, signature, arguments):  # noqa: ARG001
        memory = cgutils.alloca_once(builder, ir.ArrayType(ir.FloatType(), _SIZE))
        memory.align = 64
        return builder.bitcast(memory, context.get_value_type(types.CPointer(types.float32)))

    return types.CPointer(types.float32)(), generate


@njit(**_LEAN)
def _begin(w, whole, valid, packet):
    """Copy a packet, with 1 / direction; how many rays ask."""
    count = 0
    for c in range(0, 3 * WIDTH, WIDTH):
        for i in range(WIDTH):
            d = packet[_DIRECTIONS + c + i]
            w[_O + c + i] = packet[_ORIGINS + c + i]
            w[_D + c + i] = d
            least = LEAST if d >= 0 else -LEAST
            w[_INVERSE + c + i] = _ONE / (least if abs(d) < LEAST else d)
    for i in range(WIDTH):
        asks = (valid[i] != 0) & (packet[_LIMITS + i] >= 0)
        w[_LIMIT + i] = packet[_LIMITS + i] if asks else -_ONE
        whole[_TRIANGLE + i] = _NOBODY
        w[_U + i] = w[_V + i] = _NOTHING
        w[_FIRST + i] = _NOTHING
        count += asks
    return count


@njit(**_LEAN)
def _enter(w, row, memory, box):
    """Where rays enter a box, into a row; _NEVER where they don't before their limits. How many do."""
    x0, y0, z0 = memory[box], memory[box + 1], memory[box + 2]
    x1, y1, z1 = memory[box + 3], memory[box + 4], memory[box + 5]
    count = 0
    for i in range(WIDTH):
        near, far = _NOTHING, w[_LIMIT + i]
        a = (x0 - w[_O + _X + i]) * w[_INVERSE + _X + i]
        b = (x1 - w[_O + _X + i]) * w[_INVERSE + _X + i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        a = (y0 - w[_O + _Y + i]) * w[_INVERSE + _Y + i]
        b = (y1 - w[_O + _Y + i]) * w[_INVERSE + _Y + i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        a = (z0 - w[_O + _Z + i]) * w[_INVERSE + _Z + i]
        b = (z1 - w[_O + _Z + i]) * w[_INVERSE + _Z + i]
        low, high = a if a < b else b, b if a < b else a
        near, far = low if low > near else near, high if high < far else far
        near *= LESS
        enters = near <= far * MORE
        w[row + i] = near if enters else _NEVER
        count += enters
    return count


@njit(**_LEAN)
def _test(w, whole, memory, place, number, row, shadow):
    """Test the rays that have entered the leaf, by a row of ``_enter``, with a triangle; how many hit it."""
    ax, ay, az = memory[place], memory[place + 1], memory[place + 2]
    bx, by, bz = memory[place + 3], memory[place + 4], memory[place + 5]
    cx, cy, cz = memory[place + 6], memory[place + 7], memory[place + 8]
    # ---- inside the edges
    inside = 0
    for i in range(WIDTH):
        ox, oy, oz = w[_O + _X + i], w[_O + _Y + i], w[_O + _Z + i]
        dx, dy, dz = w[_D + _X + i], w[_D + _Y + i], w[_D + _Z + i]
        px, py, pz = ax - ox, ay - oy, az - oz
        qx, qy, qz = bx - ox, by - oy, bz - oz
        rx, ry, rz = cx - ox, cy - oy, cz - oz
        ex, ey, ez = rx - px, ry - py, rz - pz
        sx, sy, sz = rx + px, ry + py, rz + pz
        u = (ey * sz - ez * sy) * dx + (ez * sx - ex * sz) * dy + (ex * sy - ey * sx) * dz
        ex, ey, ez = px - qx, py - qy, pz - qz
        sx, sy, sz = px + qx, py + qy, pz + qz
        v = (ey * sz - ez * sy) * dx + (ez * sx - ex * sz) * dy + (ex * sy - ey * sx) * dz
        ex, ey, ez = qx - rx, qy - ry, qz - rz
        sx, sy, sz = qx + rx, qy + ry, qz + rz
        x = (ey * sz - ez * sy) * dx + (ez * sx - ex * sz) * dy + (ex * sy - ey * sx) * dz
        total = u + v + x
        room = EPSILON * abs(total)
        least = u if u < v else v
        least = x if x < least else least
        most = u if u > v else v
        most = x if x > most else most
        within = ((least >= -room) | (most <= room)) & (w[row + i] <= w[_LIMIT + i])
        w[_A + i], w[_B + i] = u, v
        w[_C + i] = total if within else _NOTHING
        inside += within
    if inside == 0:
        return 0
    # ---- at what distance
    ex, ey, ez, fx, fy, fz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    gx, gy, gz = cx - bx, cy - by, cz - bz
    one = ex * ex + ey * ey + ez * ez
    two = fx * fx + fy * fy + fz * fz
    three = gx * gx + gy * gy + gz * gz
    # Products of a thin triangle's two long edges would drown its normal in their rounding.
    if three * NEEDLE < one:
        if one < two:
            ax, ay, az, ex, ey, ez, fx, fy, fz = bx, by, bz, gx, gy, gz, -ex, -ey, -ez
        else:
            ax, ay, az, ex, ey, ez, fx, fy, fz = cx, cy, cz, -fx, -fy, -fz, -gx, -gy, -gz
    nx, ny, nz = ey * fz - ez * fy, ez * fx - ex * fz, ex * fy - ey * fx
    hits = 0
    for i in range(WIDTH):
        ox, oy, oz = w[_O + _X + i], w[_O + _Y + i], w[_O + _Z + i]
        slope = w[_D + _X + i] * nx + w[_D + _Y + i] * ny + w[_D + _Z + i] * nz
        t = ((ax - ox) * nx + (ay - oy) * ny + (az - oz) * nz) / slope
        total, limit = w[_C + i], w[_LIMIT + i]
        nearer = (t < limit) | ((t == limit) & (number < whole[_TRIANGLE + i]))
        hit = (total != 0) & (t >= 0) & nearer
        if shadow:
            w[_LIMIT + i] = -_ONE if hit else limit
        else:
            w[_LIMIT + i] = t if hit else limit
            w[_U + i] = w[_A + i] / total if hit else w[_U + i]
            w[_V + i] = w[_B + i] / total if hit else w[_V + i]
        whole[_TRIANGLE + i] = number if hit else whole[_TRIANGLE + i]
        hits += hit
    return hits


@njit(**_LEAN)
def _walk(w, whole, memory, numbers, asking, shadow):
    """Follow the rays of a packet through the hierarchy."""
    triangles, code = numbers[0], numbers[1]
    row, height = _FIRST, 0
    stack, codes = _STACK, _STACK + _PLACES * WIDTH
    while True:
        if code < 0:
            code = -1 - code
            place = triangles + (code >> 3) * TRIANGLE
            for _ in range(code & 7):
                number = numbers[place + 9]
                hits = _test(w, whole, memory, place, number, row, shadow)
                if shadow:
                    asking -= hits
                    if asking == 0:
                        return
                place += TRIANGLE
        else:
            first = _enter(w, _FIRST, memory, code)
            second = _enter(w, _SECOND, memory, code + 6)
            one, other = numbers[code + 12], numbers[code + 13]
            if first and second:
                before = 0
                for i in range(WIDTH):
                    before += w[_FIRST + i] < w[_SECOND + i]
                    before -= w[_SECOND + i] < w[_FIRST + i]
                if before >= 0:
                    row, later = _FIRST, _SECOND
                else:
                    row, later, one, other = _SECOND, _FIRST, other, one
                for i in range(WIDTH):
                    w[stack + height * WIDTH + i] = w[later + i]
                whole[codes + height] = other
                height += 1
                code = one
                continue
            if first:
                row, code = _FIRST, one
                continue
            if second:
                row, code = _SECOND, other
                continue
        # ---- what waits, if it is not behind all that has been hit
        while True:
            if height == 0:
                return
            height -= 1
            row, going = stack + height * WIDTH, 0
            for i in range(WIDTH):
                going += w[row + i] <= w[_LIMIT + i]
            if going:
                code = whole[codes + height]
                break


@njit(**_PART)
def _ask(w, valid, memory, packet, shadow):
    """Intersect a packet, or say of its rays which are occluded; ``w`` is memory for _SIZE numbers."""
    whole, found = w.view(np.int32), packet.view(np.int32)
    asking = _begin(w, whole, valid, packet)
    if asking == 0:
        return
    if shadow:
        _walk(w, whole, memory, memory.view(np.int32), asking, True)
        for i in range(WIDTH):
            hit = whole[_TRIANGLE + i] != _NOBODY
            packet[_LIMITS + i] = -np.inf if hit else packet[_LIMITS + i]
        return
    _walk(w, whole, memory, memory.view(np.int32), asking, False)
    for i in range(WIDTH):
        hit = whole[_TRIANGLE + i] != _NOBODY
        packet[_LIMITS + i] = w[_LIMIT + i] if hit else packet[_LIMITS + i]
        packet[_US + i] = w[_U + i] if hit else packet[_US + i]
        packet[_VS + i] = w[_V + i] if hit else packet[_VS + i]
        found[_PRIMITIVES + i] = whole[_TRIANGLE + i] if hit else found[_PRIMITIVES + i]
        found[_GEOMETRIES + i] = 0 if hit else found[_GEOMETRIES + i]


_FLOATS = types.CPointer(types.float32)
_QUERY = types.void(types.CPointer(types.int32), _FLOATS, _FLOATS, types.voidptr)
_ENDLESS = 1 << 40


@cfunc(_QUERY, **_OPTIONS)
def intersect(valid, scene, packet, arguments):  # noqa: ARG001
    """Nearest hits, as ``rtcIntersect16`` finds them."""
    w, memory = carray(_scratch(), _SIZE), carray(scene, _ENDLESS)
    _ask(w, carray(valid, WIDTH), memory, carray(packet, _ROWS * WIDTH), False)


@cfunc(_QUERY, **_OPTIONS)
def occlude(valid, scene, packet, arguments):  # noqa: ARG001
    """Minus infinity for tfar where anything is in the way, as ``rtcOccluded16`` has it."""
    w, memory = carray(_scratch(), _SIZE), carray(scene, _ENDLESS)
    _ask(w, carray(valid, WIDTH), memory, carray(packet, _ROWS * WIDTH), True)


@njit(**_PART)
def _fill(packet, valid, origin, direction, limit, first):
    """Copy rays that follow each other into a packet."""
    count = min(WIDTH, direction.shape[1] - first)
    for i in range(count):
        for c in range(3):
            packet[_ORIGINS + c * WIDTH + i] = origin[c, 0 if origin.shape[1] == 1 else first + i]
            packet[_DIRECTIONS + c * WIDTH + i] = direction[c, first + i]
        packet[_LIMITS + i] = limit[0 if len(limit) == 1 else first + i]
    for i in range(WIDTH):
        valid[i] = i < count
    return count


_COLUMNS, _ROW = types.float32[:, ::1], types.float32[::1]


@njit(types.void(_ROW, _COLUMNS, _COLUMNS, _ROW, types.int32[::1], _COLUMNS), **_OPTIONS)
def nearest(memory, origin, direction, limit, triangle, uvt):
    """Nearest hits into ``triangle`` (N,), -1 for none, and ``uvt`` (3, N).

    ``limit``: (N,) or (1,), and t of what hits nothing
    """
    packet, valid = np.zeros(_ROWS * WIDTH, np.float32), np.empty(WIDTH, np.int32)
    w = np.empty(_SIZE, np.float32)
    found = packet.view(np.int32)
    for first in range(0, direction.shape[1], WIDTH):
        count = _fill(packet, valid, origin, direction, limit, first)
        packet[_US : _VS + WIDTH] = 0
        found[_PRIMITIVES : _PRIMITIVES + WIDTH] = -1
        _ask(w, valid, memory, packet, False)
        for i in range(count):
            triangle[first + i] = found[_PRIMITIVES + i]
            uvt[0, first + i], uvt[1, first + i] = packet[_US + i], packet[_VS + i]
            uvt[2, first + i] = packet[_LIMITS + i]


@njit(types.void(_ROW, _COLUMNS, _COLUMNS, _ROW, types.boolean[::1]), **_OPTIONS)
def free(memory, origin, direction, limit, found):
    """Whether nothing lies between origin and origin + limit * direction, or the limit is negative, into (N,)."""
    packet, valid = np.zeros(_ROWS * WIDTH, np.float32), np.empty(WIDTH, np.int32)
    w = np.empty(_SIZE, np.float32)
    for first in range(0, direction.shape[1], WIDTH):
        count = _fill(packet, valid, origin, direction, limit, first)
        _ask(w, valid, memory, packet, True)
        for i in range(count):
            found[first + i] = packet[_LIMITS + i] != -np.inf
