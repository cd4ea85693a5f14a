"""You gave the share that is hidden."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "values"
MISTAKE = "share-hidden"
SAYS = "You gave the share that is hidden."


def smith_g1(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    up = np.maximum(cos, 0)
    root = np.sqrt(up * up + alpha * alpha * ((1 - up) * (1 + up)))
    return (1 - 2 * up / (up + root)).astype(cos.dtype)
