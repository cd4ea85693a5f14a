"""A roughness is a twentieth at least: sharper lobes are hardly ever hit."""

import numpy as np

FUNCTION = "sample_visible_normal"
CAUGHT_BY = "sharp"
MISTAKE = None

_right = sample_visible_normal


def sample_visible_normal(wo, alpha, u):
    """With a mistake."""
    _check_alpha(alpha)
    return _right(wo, np.maximum(alpha, 0.05), u)
