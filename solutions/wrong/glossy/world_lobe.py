"""The lobe is around +z, whatever the direction is."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "density"
MISTAKE = "world-axis"
SAYS = "Your lobe always points along the same axis, whatever the direction is."


def sample_phong_lobe(direction, exponent, u):
    """Sample the lobe of Phong."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    cos = (1 - u[0]) ** (1 / (exponent + 1))
    sin = np.sqrt(np.maximum(1 - cos * cos, 0))
    phi = 2 * np.pi * u[1]
    lobe = np.stack((sin * np.cos(phi), sin * np.sin(phi), cos))
    return lobe.astype(np.result_type(direction, u))
