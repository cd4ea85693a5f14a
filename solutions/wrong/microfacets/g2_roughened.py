"""A roughness is a hundredth at least, so that nothing is divided by 0."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "slanting"
MISTAKE = None

_right = smith_g2


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check_alpha(alpha)
    return _right(cos_o, cos_i, np.maximum(alpha, 0.01))
