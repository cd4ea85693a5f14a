"""The direction through the ball's point keeps its length."""

import numpy as np

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "unit_length"
MISTAKE = "not-normalised"
SAYS = "Your points are right, but the directions to them are not brought back to length 1."


def jitter_in_ball(direction, glossiness, u):
    """Jitter by a ball."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    dtype = np.result_type(direction, u)
    if glossiness == 0:
        return direction.astype(dtype)
    z = 1 - 2 * u[0]
    ring = np.sqrt(np.maximum(1 - z * z, 0))
    phi = 2 * np.pi * u[1]
    point = np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
    point = point * np.cbrt(u[2])
    return (direction + glossiness * point).astype(dtype)
