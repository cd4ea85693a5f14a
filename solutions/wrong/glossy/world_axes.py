"""The square lies in the world's x and y instead of across the direction."""

import numpy as np

FUNCTION = "jitter_on_plane"
CAUGHT_BY = "square"
MISTAKE = "world-axes"
SAYS = "Your square lies along the world's axes; it has to be at right angles to each direction."


def jitter_on_plane(direction, roughness, u):
    """Jitter x and y."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    if roughness == 0:
        return direction.astype(dtype)
    jittered = direction.astype(dtype)
    jittered[0] += roughness * (u[0] - 0.5)
    jittered[1] += roughness * (u[1] - 0.5)
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
