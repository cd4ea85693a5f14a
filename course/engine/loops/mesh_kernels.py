"""Points on lights of triangles, compiled by Numba; a part of the fused loop.

In the same order of arithmetic as ``MeshLight.sample`` and ``Groups.choose``.
"""

from typing import NamedTuple

import numpy as np

from course.engine.core.lights.sample import CLOSEST
from course.engine.core.types import Floats32, Indices
from course.engine.loops.lanes import FACTOR, INVERSE, POINT, SHADOW_TO, STRENGTH, U
from course.engine.loops.options import LEAN, njit
from course.engine.loops.packet_kernels import WIDTH

_NOTHING, _ONE = np.float32(0), np.float32(1)
_LEAST = np.float32(CLOSEST * CLOSEST)
_Y, _Z = WIDTH, 2 * WIDTH


class Meshes(NamedTuple):
    """All triangles of L lights, light by light; of other lights none. See ``Groups`` and ``MeshLight``.

    Attributes
    ----------
    group, place, triangle_of : (L + 1,) where each light begins in rows of groups, of ``shares``, and of triangles
    trust : (L,) float32
    moments : (G, 10); share, start, last : (G,)
    shares : (S,)
    triangle : (T,) the light's triangles group by group, counted from its first
    planes, edges : (T, 8)
    """

    group: Indices
    place: Indices
    triangle_of: Indices
    trust: Floats32
    moments: Floats32
    share: Floats32
    start: Floats32
    last: Floats32
    shares: Floats32
    triangle: Indices
    planes: Floats32
    edges: Floats32


@njit(**LEAN)
def _strengths(meshes, k, i, s):
    """What each group sends to lane i's point, into STRENGTH; the sum of all by their shares."""
    total = _NOTHING
    moments, first = meshes.moments, meshes.group[k]
    for g in range(meshes.group[k + 1] - first):
        m = first + g
        x = s[POINT + i] - moments[m, 0]
        y = s[POINT + _Y + i] - moments[m, 1]
        z = s[POINT + _Z + i] - moments[m, 2]
        height = moments[m, 3] * x + moments[m, 4] * y + moments[m, 5] * z + moments[m, 6]
        squared = x * x + y * y + z * z
        cubed = squared + moments[m, 9]
        cubed *= np.sqrt(cubed)
        squared = squared * moments[m, 7] + height * height + moments[m, 8]
        strength = (np.sqrt(squared) + height * meshes.trust[k]) / cubed
        s[STRENGTH + g] = strength
        total += strength * meshes.share[m]
    return total


@njit(**LEAN)
def _found(shares, first, end, place):
    """The first of some ascending shares that is above a place."""
    low, high = first, end
    while low < high:
        middle = (low + high) // 2
        if shares[middle] <= place:
            low = middle + 1
        else:
            high = middle
    return low - first


@njit(**LEAN)
def towards_triangles(meshes, k, s):
    """Fill ``SHADOW_TO``, ``INVERSE`` and ``FACTOR`` for points on light k."""
    first, groups = meshes.group[k], meshes.group[k + 1] - meshes.group[k]
    for i in range(WIDTH):
        total = _strengths(meshes, k, i, s)
        wanted = s[U + i] * total
        chosen, before = 0, _NOTHING
        through = s[STRENGTH] * meshes.share[first]
        while through <= wanted and chosen < groups - 1:
            chosen, before = chosen + 1, through
            through += s[STRENGTH + chosen] * meshes.share[first + chosen]
        own = s[STRENGTH + chosen]
        place = min(
            (wanted - before) / own + meshes.start[first + chosen], meshes.last[first + chosen]
        )
        t = _found(meshes.shares, meshes.place[k], meshes.place[k + 1], place)
        t = np.uint64(meshes.triangle_of[k] + meshes.triangle[meshes.triangle_of[k] + t])
        planes, edges = meshes.planes, meshes.edges
        root = np.sqrt(s[U + WIDTH + i])
        along_1, along_2 = _ONE - root, root * s[U + 2 * WIDTH + i]
        x = planes[t, 0] - s[POINT + i] + edges[t, 0] * along_1
        y = planes[t, 1] - s[POINT + _Y + i] + edges[t, 1] * along_1
        z = planes[t, 2] - s[POINT + _Z + i] + edges[t, 2] * along_1
        x += edges[t, 3] * along_2
        y += edges[t, 4] * along_2
        z += edges[t, 5] * along_2
        nx, ny, nz, offset = planes[t, 3], planes[t, 4], planes[t, 5], planes[t, 6]
        height = nx * x + ny * y + nz * z
        above = np.copysign(offset, height)
        x, y, z = x - nx * above, y - ny * above, z - nz * above
        arriving = _ONE / max(x * x + y * y + z * z, _LEAST)
        inverse = np.sqrt(arriving)
        cosine = min(abs(height) * inverse, _ONE)
        if not abs(height) > offset + offset:
            cosine = _NOTHING
        s[SHADOW_TO + i], s[SHADOW_TO + _Y + i], s[SHADOW_TO + _Z + i] = x, y, z
        s[INVERSE + i] = inverse
        s[FACTOR + i] = arriving * cosine * (total / own)
