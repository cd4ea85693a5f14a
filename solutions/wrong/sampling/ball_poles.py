"""In the ball, the angle from the pole is uniform."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-crowded-poles"
SAYS = "Your points crowd the poles: what is uniform is the height, not the angle from the pole."


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    phi = u.dtype.type(2 * np.pi) * u[1]
    theta = u.dtype.type(np.pi) * u[0]
    ring = np.sin(theta)
    return np.cbrt(u[2]) * np.stack((ring * np.cos(phi), ring * np.sin(phi), np.cos(theta)))
