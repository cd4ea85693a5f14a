"""The choice of a path's way, compiled by Numba; imported by ``course.transport.path_bounce``, when it is used."""

from __future__ import annotations

import numpy as np
from numba import njit, types

from course.geometry.kernels import COLUMNS, OPTIONS, ROW
from course.transport.path_bounce import DIFFUSE, LEAST, MIRRORED, REFRACTED

_NOTHING = np.float32(0)


@njit(
    types.void(types.int64[::1], *(COLUMNS,) * 2, *(ROW,) * 3, COLUMNS, types.int8[::1]),
    **OPTIONS,
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
            scale = total / max(diffuse, LEAST)
            for c in range(3):
                after[c, j] *= scale
        elif level < reach or not boundaries:
            kind[j] = MIRRORED
            scale = total / max(back, LEAST)
            for c in range(3):
                after[c, j] = (mirror[c, one] + more) * beta[c, k] * scale
        else:
            kind[j] = REFRACTED
            scale = total / max(through_most, LEAST)
            for c in range(3):
                after[c, j] = through * beta[c, k] * scale
