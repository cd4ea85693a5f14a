"""Loops over the hits of a batch, compiled by Numba; imported where they are used, and only then.

They do what passes over arrays do elsewhere, in the same order and so to the same bits; but a hit's numbers stay in
registers on the way, where forty passes carry them to the cache and back.
"""

import math

import numpy as np
from numba import njit, types

from course.compiled.bounce_kernels import above
from course.compiled.options import COLUMNS, OBJECTS, OPTIONS, ROW
from course.compiled.point_kernels import interpolated, place

_NOTHING, _ONE = np.float32(0), np.float32(1)
_AHEAD = 64
"""Hits whose rows are touched before they are worked on: then the processor waits for many of them at once."""


@njit(**OPTIONS)
def _touched(begin, end, hit, triangle, planes, edges, corner_normals):
    """Read a number of each row, so that it is in the cache; the sum is there so that the reading isn't left out."""
    total = _NOTHING
    for i in range(begin, end):
        k = triangle[hit[i] if len(hit) else i]
        total += planes[k, 0] + planes[k, 7] + edges[k, 0] + edges[k, 7]
        if corner_normals.shape[0]:
            total += corner_normals[k, 0] + corner_normals[k, 8]
    return total


@njit(
    types.float32(
        *(types.int64[::1], types.int32[::1], ROW, ROW, ROW, COLUMNS),
        *(COLUMNS, COLUMNS, COLUMNS, COLUMNS, types.uint16[::1], types.boolean),
        *(types.int32[::1], COLUMNS, COLUMNS, types.uint16[::1]),
        *(COLUMNS, COLUMNS, COLUMNS, ROW, COLUMNS, ROW),
    ),
    **OPTIONS,
)
def find(
    hit,
    triangle,
    u,
    v,
    t,
    direction,
    planes,
    edges,
    inset,
    corner_normals,
    materials,
    bends,
    met,
    uvt,
    arriving,
    material,
    p,
    ng,
    ns,
    offset,
    above,
    side,
):
    """Fill what ``Hits`` says; what is returned means nothing.

    Parameters
    ----------
    hit : (n,) which of the rays hit something; (0,) for all
    triangle, u, v, t, direction : (N,) and (3, N) of the rays
    planes, edges, inset, corner_normals : of ``Surface``; the last is (0, 9) where all triangles are flat
    materials : (T,) of ``Surface``
    bends : whether normals that look away from the ray are bent until they no longer do
    met, uvt, arriving : (n,) and (3, n), filled with the above of the rays that hit; without columns if all do
    material, p, ng, ns, offset, above, side : (n,) and (3, n), filled; ``ns`` is (3, 0) where all triangles are flat
    """
    smooth = corner_normals.shape[0] > 0
    some = len(hit) > 0
    total = _NOTHING
    for i in range(len(side)):
        if i % _AHEAD == 0:
            end = min(i + _AHEAD, len(side))
            total += _touched(i, end, hit, triangle, planes, edges, corner_normals)
        j = hit[i] if some else i
        k = triangle[j]
        a, b = u[j], v[j]
        dx, dy, dz = direction[0, j], direction[1, j], direction[2, j]
        if some:
            met[i] = k
            uvt[0, i], uvt[1, i], uvt[2, i] = a, b, t[j]
            arriving[0, i], arriving[1, i], arriving[2, i] = dx, dy, dz
        material[i] = materials[k]
        x, y, z = place(k, a, b, planes, edges, inset)
        nx, ny, nz = planes[k, 3], planes[k, 4], planes[k, 5]
        # A sum that begins with 0, as NumPy's does, is never -0.
        facing = _NOTHING + nx * dx + ny * dy + nz * dz
        way = np.float32(math.copysign(_ONE, -facing))
        nx, ny, nz = nx * way, ny * way, nz * way
        far = planes[k, 6]
        p[0, i], p[1, i], p[2, i] = x, y, z
        ng[0, i], ng[1, i], ng[2, i] = nx, ny, nz
        above[0, i], above[1, i], above[2, i] = x + nx * far, y + ny * far, z + nz * far
        offset[i], side[i] = far, way
        if smooth:
            if planes[k, 7] > 0:
                ns[0, i], ns[1, i], ns[2, i] = nx, ny, nz
                continue
            nx, ny, nz = interpolated(k, a, b, way, dx, dy, dz, corner_normals, bends)
            ns[0, i], ns[1, i], ns[2, i] = nx, ny, nz
    return total


@njit(types.void(types.int64[::1], *(COLUMNS,) * 4), **OPTIONS)
def mirror(which, direction, ns, ng, way):
    """Mirrored directions of some hits, none of them into the surface, into ``way`` (3, m).

    Parameters
    ----------
    which : (m,) the hits
    direction, ns : (3, n) of all hits
    ng : (3, m) of those
    """
    for i in range(len(which)):
        j = which[i]
        dx, dy, dz = direction[0, j], direction[1, j], direction[2, j]
        nx, ny, nz = ns[0, j], ns[1, j], ns[2, j]
        twice = dx * nx + dy * ny + dz * nz
        twice += twice
        x, y, z = dx - twice * nx, dy - twice * ny, dz - twice * nz
        x, y, z = above(x, y, z, ng[0, i], ng[1, i], ng[2, i])
        way[0, i], way[1, i], way[2, i] = x, y, z


@njit(
    types.void(
        *(types.int64[::1], types.int32[::1], ROW, COLUMNS, COLUMNS),
        *(types.int32[::1], types.boolean[::1], OBJECTS),
    ),
    **OPTIONS,
)
def leave(which, triangle, side, ng, direction, first, worth, left):
    """The convex object that each ray leaves outwards, or -1, into ``left`` (m,).

    Parameters
    ----------
    which : (m,) the hits that the rays leave
    triangle, side, ng : (n,), (n,) and (3, n) of all hits, as ``Hits`` has them
    direction : (3, m) of the rays
    first, worth : of ``ConvexObjects``
    """
    for i in range(len(which)):
        j = which[i]
        # The normal is on the incoming side: a ray that leaves on that side leaves the object if it came from outside.
        up = direction[0, i] * ng[0, j] + direction[1, i] * ng[1, j] + direction[2, i] * ng[2, j]
        left[i] = -1
        if up * side[j] > 0:
            number = 0
            for k in range(1, len(worth)):
                number += triangle[j] >= first[k]
            if worth[number]:
                left[i] = number
