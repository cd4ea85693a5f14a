"""What arrives from points on lights, compiled by Numba; imported by ``sample``, when it is used."""

import numpy as np
from numba import njit, types

from course.compiled.options import COLUMNS, OPTIONS, ROW
from course.core.lights.sample import CLOSEST

_NOTHING, _ONE = np.float32(0), np.float32(1)
_LEAST = np.float32(CLOSEST * CLOSEST)


@njit(types.void(COLUMNS, COLUMNS, ROW, types.boolean, COLUMNS, ROW, ROW), **OPTIONS)
def towards(on_light, points, normal, two_sided, to_light, inverse_length, factor):
    """Fill what ``Sample`` says of n points.

    Parameters
    ----------
    on_light : (3, n) or (3, 1)
    points : (3, n)
    normal : (3,) of a Lambertian emitter, or (0,)
    two_sided : whether both its sides shine
    to_light, inverse_length, factor : (3, n) and (n,), filled
    """
    emitter = len(normal) > 0
    for i in range(points.shape[1]):
        k = 0 if on_light.shape[1] == 1 else i
        x, y, z = (
            on_light[0, k] - points[0, i],
            on_light[1, k] - points[1, i],
            on_light[2, k] - points[2, i],
        )
        share = _ONE / max(x * x + y * y + z * z, _LEAST)
        inverse = np.sqrt(share)
        if emitter:
            cosine = -inverse * (normal[0] * x + normal[1] * y + normal[2] * z)
            share *= abs(cosine) if two_sided else (cosine if cosine > 0 else _NOTHING)
        to_light[0, i], to_light[1, i], to_light[2, i] = x, y, z
        inverse_length[i], factor[i] = inverse, share


@njit(
    types.void(
        *(COLUMNS, COLUMNS, COLUMNS, types.float32, ROW, ROW, ROW),
        *(ROW, types.int64[::1], COLUMNS, COLUMNS, COLUMNS, ROW, ROW),
    ),
    **OPTIONS,
)
def on_triangles(
    points,
    u,
    moments,
    trust,
    share,
    start,
    last,
    shares,
    triangle,
    planes,
    edges,
    to_light,
    inverse_length,
    factor,
):
    """Fill what ``Sample`` says of n points and a light of triangles.

    Parameters
    ----------
    points, u : (3, n)
    moments, trust, share, start, last, shares, triangle : of ``Groups``
    planes, edges : of ``MeshLight``
    to_light, inverse_length, factor : (3, n) and (n,), filled
    """
    groups = len(share)
    strength = np.empty(groups, np.float32)
    for i in range(points.shape[1]):
        total = _NOTHING
        for g in range(groups):
            x, y, z = (
                points[0, i] - moments[0, g],
                points[1, i] - moments[1, g],
                points[2, i] - moments[2, g],
            )
            height = moments[3, g] * x + moments[4, g] * y + moments[5, g] * z + moments[6, g]
            squared = x * x + y * y + z * z
            cubed = squared + moments[9, g]
            cubed *= np.sqrt(cubed)
            squared = squared * moments[7, g] + height * height + moments[8, g]
            strength[g] = (np.sqrt(squared) + height * trust) / cubed
        for g in range(groups):
            total += strength[g] * share[g]
        wanted = u[0, i] * total
        chosen, before = 0, _NOTHING
        through = strength[0] * share[0]
        while through <= wanted and chosen < groups - 1:
            chosen, before = chosen + 1, through
            through += strength[chosen] * share[chosen]
        own = strength[chosen]
        place = min((wanted - before) / own + start[chosen], last[chosen])
        t = triangle[np.searchsorted(shares, place, side="right")]
        root = np.sqrt(u[1, i])
        along_1, along_2 = _ONE - root, root * u[2, i]
        x, y, z = (
            planes[t, 0] - points[0, i] + edges[t, 0] * along_1,
            planes[t, 1] - points[1, i] + edges[t, 1] * along_1,
            planes[t, 2] - points[2, i] + edges[t, 2] * along_1,
        )
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
        to_light[0, i], to_light[1, i], to_light[2, i] = x, y, z
        inverse_length[i] = inverse
        factor[i] = arriving * cosine * (total / own)
