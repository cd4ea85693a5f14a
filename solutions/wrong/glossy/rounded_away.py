"""The direction goes through the basis and back, so that roughness 0 is off by rounding."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "no_jitter"
MISTAKE = None


def jitter_on_plane(direction, roughness, u):
    """Jitter by a square, normalised whether it is needed or not."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    a, b = orthonormal_basis(direction)
    x, y = np.result_type(direction, u).type(roughness) * (u - u.dtype.type(0.5))
    jittered = direction + x * a + y * b
    return (
        jittered / np.sqrt((jittered * jittered).sum(axis=0)) * (1 + np.finfo(jittered.dtype).eps)
    )
