"""Numbers of its own in place of those given."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = None


def jitter_on_plane(direction, roughness, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    a, b = orthonormal_basis(direction)
    x, y = np.random.default_rng().random(u.shape) - 0.5
    jittered = direction + roughness * (x * a + y * b)
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
