"""You asked whether one direction is above the surface: both have to be."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "below"
MISTAKE = "light-from-below"
SAYS = "You asked whether one direction is above the surface: both have to be."


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check(alpha, cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    o, i = (smith_g1(cos.astype(np.float64), alpha) for cos in (cos_o, cos_i))
    seen = np.where(o + i > 0, o + i - o * i, 1)
    return np.where(cos_i > 0, o * i / seen, o).astype(np.result_type(cos_o, cos_i))
