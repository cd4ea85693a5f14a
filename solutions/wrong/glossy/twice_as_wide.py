"""The square reaches from -roughness to roughness."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = "twice-as-wide"
SAYS = "Your square is twice as wide: roughness is its whole side, not half of it."


def jitter_on_plane(direction, roughness, u):
    """Jitter by a square."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    if roughness == 0:
        return direction.astype(dtype)
    a, b = orthonormal_basis(direction)
    x, y = roughness * (2 * u - 1)
    jittered = direction + x * a + y * b
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
