"""The ball's points crowd around two poles: the polar angle is uniform."""

import numpy as np

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "ball-crowded-poles"
SAYS = "The polar angle itself is uniform, so points crowd around two poles."


def jitter_in_ball(direction, glossiness, u):
    """Jitter by a ball."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    dtype = np.result_type(direction, u)
    if glossiness == 0:
        return direction.astype(dtype)
    theta = np.pi * u[0]
    phi = 2 * np.pi * u[1]
    point = np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)))
    jittered = direction + glossiness * np.cbrt(u[2]) * point
    return (jittered / np.linalg.norm(jittered, axis=0)).astype(dtype)
