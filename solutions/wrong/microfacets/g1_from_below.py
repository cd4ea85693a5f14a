"""A direction from below sees no front: the square of its cosine does not tell."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "below"
MISTAKE = "seen-from-below"
SAYS = "A direction from below sees no front: the square of its cosine does not tell."


def smith_g1(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    up = np.abs(cos)
    root = np.sqrt(up * up + alpha * alpha * ((1 - up) * (1 + up)))
    return (2 * up / (up + root)).astype(cos.dtype)
