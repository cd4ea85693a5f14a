"""Both sides of the square are driven by the same number."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = "one-number"
SAYS = "Your jitter runs along one line: both sides of the square are driven by the same number."


def jitter_on_plane(direction, roughness, u):
    """Jitter by a square."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    if roughness == 0:
        return direction.astype(dtype)
    a, b = orthonormal_basis(direction)
    x = roughness * (u[0] - 0.5)
    jittered = direction + x * a + x * b
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
