"""Which hits a light may reach, compiled by Numba; imported by ``course.compiled.direct``, when it is used."""

import numpy as np
from numba import njit, types

from course.compiled.options import COLUMNS, OPTIONS, ROW

_NOTHING = np.float32(0)


@njit(
    types.int64(
        *(COLUMNS, types.uint16[::1], ROW, COLUMNS, ROW, ROW, types.boolean[:, ::1]),
        *(types.int64[::1], ROW, ROW),
    ),
    **OPTIONS,
)
def facing(ns, material, side, to_light, inverse_length, factor, shaded, which, strength, cosine):
    """How many hits face the light and are faced by it.

    Parameters
    ----------
    ns, material, side : (3, n) and (n,) of all hits
    to_light, inverse_length, factor : of a ``Sample``, each for n hits or one for all
    shaded : (1 or 2, M) which materials show light, from the back too where there are two rows; (0, 0) for all
    which, strength, cosine : (n,), filled from the beginning with as many as there are
    """
    found = 0
    for i in range(len(material)):
        k = 0 if to_light.shape[1] == 1 else i
        angle = (
            _NOTHING
            + ns[0, i] * to_light[0, k]
            + ns[1, i] * to_light[1, k]
            + ns[2, i] * to_light[2, k]
        )
        angle *= inverse_length[k]
        light = angle * factor[k]
        row = 1 if len(shaded) > 1 and not side[i] > 0 else 0
        # Which face it is chance, so a branch would be foretold badly: the others are overwritten by the next.
        which[found], strength[found], cosine[found] = i, light, angle
        found += (light > 0) & (len(shaded) == 0 or shaded[row, material[i]])
    return found


@njit(types.void(types.int64[::1], COLUMNS, COLUMNS, ROW, COLUMNS, COLUMNS, ROW), **OPTIONS)
def gather(which, above, to_light, inverse_length, origin, there, near):
    """Where shadow rays of some hits start and go; the latter is left out if all hits share it.

    Parameters
    ----------
    which : (m,) the hits
    above, to_light, inverse_length : (3, n) and (n,) of all hits
    origin, there, near : (3, m) and (m,), filled; (3, m), (3, 0) and (0,) if all hits share the light's direction
    """
    for i in range(len(which)):
        j = which[i]
        for c in range(3):
            origin[c, i] = above[c, j]
        if len(near):
            for c in range(3):
                there[c, i] = to_light[c, j]
            near[i] = inverse_length[j]


@njit(
    types.int64(types.int64[::1], ROW, COLUMNS, COLUMNS, types.float32, types.int64[::1]), **OPTIONS
)
def turned(which, cosine, ng, to_light, most, found):
    """How many of some hits have facets that turn away from the light.

    Parameters
    ----------
    which, cosine, to_light : (m,) and (3, m) of those hits
    ng : (3, n) of all hits
    most : the cosine up to which that may be
    found : (m,) filled from the beginning with the numbers of those hits
    """
    count = 0
    for i in range(len(which)):
        if cosine[i] <= most:
            j = which[i]
            if (
                ng[0, j] * to_light[0, i] + ng[1, j] * to_light[1, i] + ng[2, j] * to_light[2, i]
                <= 0
            ):
                found[count] = i
                count += 1
    return count


@njit(types.void(types.int64[::1], ROW, ROW, COLUMNS), **OPTIONS)
def spread(which, values, color, total):
    """Add values (m,) of some hits, times a colour (3,), to ``total`` (3, n) of all hits."""
    for c in range(3):
        for i in range(len(which)):
            total[c, which[i]] += values[i] * color[c]


@njit(types.void(types.uint16[::1], *(COLUMNS,) * 5), **OPTIONS)
def reflect(material, rows, tint, specular_rows, specular, diffuse):
    """Multiply what arrives at n hits by their materials' reflectances, into ``diffuse``.

    Parameters
    ----------
    material : (n,) of the hits
    rows, specular_rows : (3, M) reflectances
    tint : (3, n) of textures; (3, 0) for none
    specular : (3, n) sums of highlights; (3, 0) for none
    diffuse : (3, n) sums of irradiance, replaced by radiance
    """
    tints, highlights = tint.shape[1] > 0, specular.shape[1] > 0
    for c in range(3):
        for i in range(len(material)):
            radiance = diffuse[c, i] * rows[c, material[i]]
            if tints:
                radiance *= tint[c, i]
            if highlights:
                radiance += specular[c, i] * specular_rows[c, material[i]]
            diffuse[c, i] = radiance


@njit(types.void(types.float32[:, :], types.int64[::1], COLUMNS, COLUMNS), **OPTIONS)
def add(film, path, radiance, throughput):
    """Add radiance (3, n), times its throughput (3, n), to the paths (n,) that it belongs to."""
    for i in range(len(path)):
        for c in range(3):
            film[c, path[i]] += radiance[c, i] * throughput[c, i]
