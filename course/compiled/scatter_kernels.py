"""How light is divided among a surface's ways, compiled by Numba; imported where it is used, and only then."""

import numpy as np
from numba import njit, types

from course.compiled.bounce_kernels import above, fresnel
from course.compiled.options import COLUMNS, OPTIONS, ROW
from course.extras.path_bounce import DIFFUSE, LEAST, MIRRORED, REFRACTED

_NOTHING, _ONE = np.float32(0), np.float32(1)


@njit(
    types.void(types.int64[::1], *(COLUMNS,) * 2, *(ROW,) * 3, COLUMNS, types.int8[::1]), **OPTIONS
)
def choose(other, beta, mirror, reflected, refracted, u, after, kind):
    """Choose among the ways of some hits as ``PathBounce`` does, in place.

    Parameters
    ----------
    other : (m,) the hits on materials that mirror or refract
    beta : (3, n) or (3, 1) throughput of the rays that hit
    mirror : (3, m) or (3, 1) what opaque materials mirror
    reflected, refracted : (m,) shares of the light at a boundary; (0,) where nothing refracts
    u : (n,) in [0, 1)
    after : (3, n) throughput of diffuse reflection, replaced by that of the way that is chosen
    kind : (n,) DIFFUSE, MIRRORED or REFRACTED
    """
    boundaries = len(reflected) > 0
    for i in range(len(other)):
        j = other[i]
        k, one = (0 if beta.shape[1] == 1 else j), (0 if mirror.shape[1] == 1 else i)
        more = reflected[i] if boundaries else _NOTHING
        through = refracted[i] if boundaries else _NOTHING
        back = through_most = diffuse = _NOTHING
        for c in range(3):
            diffuse = max(diffuse, after[c, j])
            back = max(back, (mirror[c, one] + more) * beta[c, k])
            through_most = max(through_most, through * beta[c, k])
        reach = diffuse + back
        total = reach + through_most
        level = u[j] * total
        if level < diffuse:
            kind[j] = DIFFUSE
            scale = _ONE / max(diffuse, LEAST)
            for c in range(3):
                after[c, j] = after[c, j] * scale * total
        elif level < reach or not boundaries:
            kind[j] = MIRRORED
            scale = _ONE / max(back, LEAST)
            for c in range(3):
                after[c, j] = (mirror[c, one] + more) * beta[c, k] * scale * total
        else:
            kind[j] = REFRACTED
            scale = _ONE / max(through_most, LEAST)
            for c in range(3):
                after[c, j] = through * beta[c, k] * scale * total


@njit(
    types.void(
        *(types.int64[::1], types.uint16[::1], ROW, COLUMNS, COLUMNS, ROW),
        *(ROW, ROW, ROW, ROW, ROW),
    ),
    **OPTIONS,
)
def divide(which, material, side, direction, ns, index, reflected, refracted, cos_i, cos_t, ratio):
    """Divide light at boundaries as ``course.core.fresnel_refraction`` does.

    Parameters
    ----------
    which : (m,) the hits
    material, side, direction, ns : (n,) and (3, n) of all hits
    index : (M,) refraction index of each material, 0 of opaque ones
    reflected, refracted : (m,) filled, 0 where the material is opaque
    cos_i, cos_t, ratio : (m,) filled, but for opaque materials
    """
    for i in range(len(which)):
        j = which[i]
        inside = index[material[j]]
        if not inside > 0:
            reflected[i] = refracted[i] = _NOTHING
            continue
        cosine = -(
            _NOTHING
            + direction[0, j] * ns[0, j]
            + direction[1, j] * ns[1, j]
            + direction[2, j] * ns[2, j]
        )
        cosine = min(_NOTHING if cosine < 0 else cosine, _ONE)
        share, bent, eta = fresnel(inside, side[j], cosine)
        reflected[i], refracted[i] = share, _ONE - share
        cos_i[i], cos_t[i], ratio[i] = cosine, bent, eta


@njit(types.void(types.int64[::1], *(COLUMNS,) * 3, *(ROW,) * 3, COLUMNS), **OPTIONS)
def refract(which, direction, ns, ng, cos_i, cos_t, ratio, way):
    """Refracted directions of some hits, none of them back to where they came from, into ``way`` (3, m).

    Parameters
    ----------
    which : (m,) the hits
    direction, ns, ng : (3, n) of all hits
    cos_i, cos_t, ratio : (m,) of those, from ``divide``
    """
    for i in range(len(which)):
        j = which[i]
        eta = ratio[i]
        along = eta * cos_i[i] - cos_t[i]
        x = direction[0, j] * eta + ns[0, j] * along
        y = direction[1, j] * eta + ns[1, j] * along
        z = direction[2, j] * eta + ns[2, j] * along
        x, y, z = above(x, y, z, -ng[0, j], -ng[1, j], -ng[2, j])
        way[0, i], way[1, i], way[2, i] = x, y, z


@njit(
    types.int64(types.boolean[::1], types.int8[::1], types.int64[::1], types.int64[::1]), **OPTIONS
)
def sort(goes_on, kind, which, counts):
    """Put the hits whose paths go on in the order of their ways.

    Parameters
    ----------
    goes_on, kind : (n,) of all hits
    which : (n + 1,) filled from the beginning with those that go on
    counts : (3,) filled with how many take each way

    Returns
    -------
    how many go on
    """
    found = 0
    for way in (DIFFUSE, MIRRORED, REFRACTED):
        before = found
        # Which go on is chance, so a branch would be foretold badly: the others are overwritten by the next.
        for i in range(len(kind)):
            which[found] = i
            found += goes_on[i] & (kind[i] == way)
        counts[way] = found - before
    return found


@njit(types.void(types.int64[::1], types.int64, *(COLUMNS,) * 3, ROW, *(COLUMNS,) * 3), **OPTIONS)
def leave(which, above_until, above, p, ng, offset, after, origin, throughput):
    """Where the rays that go on start, and what they carry.

    Parameters
    ----------
    which : (m,) the hits that they leave
    above_until : how many of them leave on the side that the light came from; the others go through
    above, p, ng, offset, after : (3, n) and (n,) of all hits
    origin, throughput : (3, m), filled
    """
    for i in range(len(which)):
        j = which[i]
        for c in range(3):
            origin[c, i] = above[c, j] if i < above_until else p[c, j] - ng[c, j] * offset[j]
            throughput[c, i] = after[c, j]
