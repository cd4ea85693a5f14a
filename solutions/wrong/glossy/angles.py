"""Roughness scales two angles instead of a square's sides."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = "square-of-angles"
SAYS = "The roughness scales two angles. It is the side of a square at distance 1, flat and at right angles."


def jitter_on_plane(direction, roughness, u):
    """Turn by two angles."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    if roughness == 0:
        return direction.astype(dtype)
    a, b = orthonormal_basis(direction)
    x, y = np.tan(np.minimum(roughness, 1.5) * (u - 0.5))
    jittered = direction + x * a + y * b
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
