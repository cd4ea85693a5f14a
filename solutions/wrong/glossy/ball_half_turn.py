"""Half a turn."""

import numpy as np

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "ball-half-turn"
SAYS = "The angle runs over half a turn, so half of the ball gets no point."


def jitter_in_ball(direction, glossiness, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    dtype = np.result_type(direction, u)
    z = 1 - 2 * u[0]
    ring = np.sqrt(np.maximum(1 - z * z, 0))
    phi = np.pi * u[1]
    point = np.cbrt(u[2]) * np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
    jittered = direction + glossiness * point
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
