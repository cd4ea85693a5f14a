"""Numbers come from a copy of the generator, and so the same again in the next call."""

import copy

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "from_rng"
MISTAKE = None


def jittered(k, n, rng):
    """With a mistake."""
    _check_counts(k, n)
    points = copy.deepcopy(rng).random((2, n, k, k), np.float32)
    cell = np.arange(k, dtype=np.float32)
    points[0] += cell[None, :]
    points[1] += cell[:, None]
    points /= np.float32(k)
    return points.reshape(2, n, k * k)
