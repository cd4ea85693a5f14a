"""A direction from below sees no front: the square of its cosine does not tell."""

import numpy as np

FUNCTION = "smith_g2"
CAUGHT_BY = "below"
MISTAKE = "seen-from-below"


def smith_g2(cos_o, cos_i, alpha):
    """With a mistake."""
    _check(alpha, cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    o, i = (smith_g1(np.abs(cos.astype(np.float64)), alpha) for cos in (cos_o, cos_i))
    seen = np.where(o + i > 0, o + i - o * i, 1)
    return (o * i / seen).astype(np.result_type(cos_o, cos_i))
