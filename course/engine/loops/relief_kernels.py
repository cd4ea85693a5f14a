"""Shading normals of a packet's hits by normal maps and bump maps, compiled by Numba; a part of the fused loop.

See ``course.engine.terms.surfaces.normal_maps`` and ``bump_maps``.
"""

import numpy as np

from course.engine.loops.lanes import EDGES, NS, OTHERS, PLACE, SIDE
from course.engine.loops.noise_kernels import grey
from course.engine.loops.options import APART, LEAN, njit
from course.engine.loops.packet_kernels import TO, WIDTH
from course.engine.loops.paint_kernels import (
    NOISE,
    between,
    find_places,
    find_rows,
    look_up,
    weigh,
)
from course.engine.loops.point_kernels import turned
from course.engine.terms.surfaces.bump_maps import STEP as NOISE_STEP
from course.engine.terms.surfaces.normal_maps import SHORTEST, STEP

_NOTHING, _ONE, _TWO, _THREE = (np.float32(number) for number in (0, 1, 2, 3))
_Y, _Z = WIDTH, 2 * WIDTH
_LEAST = 1e-290


@njit(**LEAN)
def _cross(ax, ay, az, bx, by, bz):
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@njit(**LEAN)
def _unit(x, y, z):
    length = np.sqrt(max(x * x + y * y + z * z, _LEAST))
    return x / length, y / length, z / length


@njit(**LEAN)
def _changes(relief, k, i, s):
    """How u and v change along both edges, in places of three rows; see ``NormalMap.changes``."""
    u, v = s[PLACE + i], s[PLACE + _Y + i]
    u1, v1 = s[PLACE + 2 * WIDTH + i] - u, s[PLACE + 3 * WIDTH + i] - v
    u2, v2 = s[PLACE + 4 * WIDTH + i] - u, s[PLACE + 5 * WIDTH + i] - v
    if relief.wraps[k]:
        u1, u2 = u1 - np.rint(u1), u2 - np.rint(u2)
    return u1 / STEP, v1 / STEP, u2 / STEP, v2 / STEP


@njit(**LEAN)
def _lower(relief, k, u, v, along_u, along_v):
    """Mean of a picture's channels at one place less that at another: by so much before and behind (u, v)."""
    red, green, blue = look_up(relief, k, u + along_u, v + along_v)
    low_red, low_green, low_blue = look_up(relief, k, u - along_u, v - along_v)
    return (red - low_red + (green - low_green) + (blue - low_blue)) / _THREE


@njit(**LEAN)
def _heights_of_picture(relief, k, i, s):
    """See ``PictureHeights.changes``."""
    u1, v1, u2, v2 = _changes(relief, k, i, s)
    u, v = s[PLACE + i], s[PLACE + _Y + i]
    step_u, step_v = relief.step[k, 0], relief.step[k, 1]
    along_u = _lower(relief, k, u, v, step_u, _NOTHING) / (_TWO * step_u)
    along_v = _lower(relief, k, u, v, _NOTHING, step_v) / (_TWO * step_v)
    return along_u * u1 + along_v * v1, along_u * u2 + along_v * v2


@njit(**LEAN)
def _rise(carried, row, column, sx, sy, sz):
    """How heights of a slope change from corner 0 to the one that carries its place from a column on."""
    x = carried[row, column] - carried[row, 0]
    y = carried[row, column + 1] - carried[row, 1]
    z = carried[row, column + 2] - carried[row, 2]
    return _NOTHING + sx * x + sy * y + sz * z


@njit(**LEAN)
def _heights_of_noise(relief, k, row, i, s):
    """See ``NoiseHeights.changes``."""
    x, y, z = between(relief, row, i, s)
    step, absolute, twice = NOISE_STEP, relief.absolute[k], _TWO * NOISE_STEP
    sx = (grey(absolute, x + step, y, z) - grey(absolute, x - step, y, z)) / twice
    sy = (grey(absolute, x, y + step, z) - grey(absolute, x, y - step, z)) / twice
    sz = (grey(absolute, x, y, z + step) - grey(absolute, x, y, z - step)) / twice
    first = _rise(relief.corners, row, 3, sx, sy, sz)
    return first, _rise(relief.corners, row, 6, sx, sy, sz)


@njit(**LEAN)
def _edge(number, i, s):
    """An edge of the hit triangle, in double precision."""
    row = EDGES + 3 * number * WIDTH + i
    return np.float64(s[row]), np.float64(s[row + _Y]), np.float64(s[row + _Z])


@njit(**LEAN)
def _raised(relief, k, row, nx, ny, nz, i, s):
    """See ``BumpMap.normals``."""
    if relief.kind[k] == NOISE:
        along_1, along_2 = _heights_of_noise(relief, k, row, i, s)
    else:
        along_1, along_2 = _heights_of_picture(relief, k, i, s)
    first, second = relief.height[k] * along_1, relief.height[k] * along_2
    ax, ay, az = _edge(0, i, s)
    bx, by, bz = _edge(1, i, s)
    fx, fy, fz = _cross(ax, ay, az, bx, by, bz)
    px, py, pz = _cross(bx, by, bz, fx, fy, fz)
    qx, qy, qz = _cross(fx, fy, fz, ax, ay, az)
    squared = max(fx * fx + fy * fy + fz * fz, _LEAST)
    gx = (px * first + qx * second) / squared
    gy = (py * first + qy * second) / squared
    gz = (pz * first + qz * second) / squared
    along = gx * nx + gy * ny + gz * nz
    x, y, z = nx - (gx - along * nx), ny - (gy - along * ny), nz - (gz - along * nz)
    length = np.sqrt(x * x + y * y + z * z)
    return np.float32(x / length), np.float32(y / length), np.float32(z / length)


@njit(**LEAN)
def _mapped(relief, k, nx, ny, nz, i, s):
    """See ``NormalMap.normals``."""
    red, green, blue = look_up(relief, k, s[PLACE + i], s[PLACE + _Y + i])
    u1, v1, u2, v2 = _changes(relief, k, i, s)
    # In double precision, for small triangles' products of lengths underflow.
    u1, v1, u2, v2 = np.float64(u1), np.float64(v1), np.float64(u2), np.float64(v2)
    ax, ay, az = _edge(0, i, s)
    bx, by, bz = _edge(1, i, s)
    area = u1 * v2 - u2 * v1
    sign = 1.0 if area > 0 else (-1.0 if area < 0 else 0.0)
    ux, uy, uz = _unit(
        (ax * v2 - bx * v1) * sign, (ay * v2 - by * v1) * sign, (az * v2 - bz * v1) * sign
    )
    vx, vy, vz = (bx * u1 - ax * u2) * sign, (by * u1 - ay * u2) * sign, (bz * u1 - az * u2) * sign
    along = nx * ux + ny * uy + nz * uz
    ux, uy, uz = ux - nx * along, uy - ny * along, uz - nz * along
    flat = ux * ux + uy * uy + uz * uz <= SHORTEST
    ux, uy, uz = _unit(ux, uy, uz)
    wx, wy, wz = _cross(nx, ny, nz, ux, uy, uz)
    side = -1.0 if wx * vx + wy * vy + wz * vz < 0 else 1.0
    wx, wy, wz = wx * side, wy * side, wz * side
    x, y, z = _TWO * red - _ONE, _TWO * green - _ONE, _TWO * blue - _ONE
    tx, ty, tz = ux * x + wx * y + nx * z, uy * x + wy * y + ny * z, uz * x + wz * y + nz * z
    if flat or tx * tx + ty * ty + tz * tz <= SHORTEST:
        return nx, ny, nz
    tx, ty, tz = _unit(tx, ty, tz)
    return np.float32(tx), np.float32(ty), np.float32(tz)


@njit(**APART)
def carve(relief, call, s, whole):
    """Shading normals of reliefs into NS; see ``Relief.normals``."""
    if not find_rows(relief, whole):
        return
    for corner in (2, 1, 0):
        weigh(corner, s)
        find_places(relief, PLACE + 2 * corner * WIDTH, call, s, whole)
    for i in range(WIDTH):
        row = whole[OTHERS + i]
        if row < 0:
            continue
        k, side = relief.number[row], s[SIDE + i]
        nx, ny, nz = s[NS + i] * side, s[NS + _Y + i] * side, s[NS + _Z + i] * side
        if relief.raises[k]:
            nx, ny, nz = _raised(relief, k, row, nx, ny, nz, i, s)
        else:
            nx, ny, nz = _mapped(relief, k, nx, ny, nz, i, s)
        nx, ny, nz = nx * side, ny * side, nz * side
        dx, dy, dz = s[TO + i], s[TO + _Y + i], s[TO + _Z + i]
        s[NS + i], s[NS + _Y + i], s[NS + _Z + i] = turned(nx, ny, nz, dx, dy, dz)
