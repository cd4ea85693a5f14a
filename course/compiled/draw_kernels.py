"""Sobol numbers of some paths, compiled by Numba; imported by ``course.compiled.stages``."""

import numpy as np
from numba import njit, types

from course.compiled.number_kernels import hashed
from course.compiled.options import COLUMNS, OPTIONS
from course.extras.samplers.sobol import TO_UNIT

_BYTE = np.uint32(8)


@njit(
    types.void(
        *(types.uint32[::1], types.int64, types.int64[::1], types.uint32[:, :, ::1]),
        *(types.uint64[::1], types.int64, COLUMNS),
    ),
    **OPTIONS,
)
def draw(pixels, samples, path, points, salts, first, u):
    """Fill ``u`` as ``SobolSampler.draw_some`` does.

    Parameters
    ----------
    pixels, samples : of the block
    path : (n,) numbers of paths in the block
    points : (2 or more, orders, samples) uint32
    salts : (3,) of the pair of dimensions
    first : which of the pair's dimensions the first row is
    u : (1 or 2, n), filled
    """
    orders = np.uint32(points.shape[1])
    # The paths of a pixel mostly stand together: as long as they do, nothing is divided and nothing is hashed.
    begin = end = np.int64(0)
    order = np.int64(0)
    scramble, other = np.uint32(0), np.uint32(0)
    for i in range(len(path)):
        if not begin <= path[i] < end:
            pixel = np.uint32(path[i]) // np.uint32(samples)
            begin = np.int64(pixel) * samples
            end = begin + samples
            order = np.int64(hashed(pixels[pixel], salts[0]) % orders)
            scramble = hashed(pixels[pixel], salts[1 + first])
            if u.shape[0] > 1:
                other = hashed(pixels[pixel], salts[2])
        sample = path[i] - begin
        u[0, i] = np.float32((points[first, order, sample] ^ scramble) >> _BYTE) * TO_UNIT
        if u.shape[0] > 1:
            u[1, i] = np.float32((points[1, order, sample] ^ other) >> _BYTE) * TO_UNIT
