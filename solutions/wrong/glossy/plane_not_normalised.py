"""The jittered direction keeps its new length."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "unit_length"
MISTAKE = "not-normalised"


def jitter_on_plane(direction, roughness, u):
    """Jitter by a square."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    if roughness == 0:
        return direction.astype(dtype)
    a, b = orthonormal_basis(direction)
    x, y = roughness * (u - 0.5)
    return (direction + x * a + y * b).astype(dtype)
