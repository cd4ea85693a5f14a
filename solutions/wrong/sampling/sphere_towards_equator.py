"""Points are a hundredth of a radian nearer to the equator than they should be, halfway from the poles."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "order"
MISTAKE = None


def sphere_by_polar(u):
    """With a mistake."""
    _check_batch("u", u, 2)
    theta, phi = np.arccos(1 - 2 * u[0]), 2 * np.pi * u[1]
    theta = theta + 0.015 * np.sin(2 * theta)
    return np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)))
