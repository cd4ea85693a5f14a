"""The points fill a cube around the ball."""

import numpy as np

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "cube"
SAYS = "Your points fill a cube; its corners stick out of the ball."


def jitter_in_ball(direction, glossiness, u):
    """Jitter by a ball."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    dtype = np.result_type(direction, u)
    if glossiness == 0:
        return direction.astype(dtype)
    jittered = direction + glossiness * (2 * u - 1)
    length = np.linalg.norm(jittered, axis=0)
    jittered = np.where(length == 0, direction, jittered) / np.where(length == 0, 1, length)
    return jittered.astype(dtype)
