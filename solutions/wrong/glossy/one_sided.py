"""The square begins at the direction: u is not centred."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = "one-sided"
SAYS = "Your square starts at the direction instead of lying around it, so all reflections are shifted."


def jitter_on_plane(direction, roughness, u):
    """Jitter by a square."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    if roughness == 0:
        return direction.astype(dtype)
    a, b = orthonormal_basis(direction)
    jittered = direction + roughness * (u[0] * a + u[1] * b)
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
