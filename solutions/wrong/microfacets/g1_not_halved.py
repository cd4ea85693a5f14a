"""Lambda is half of what the root is above 1: straight along the surface you see too little."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "values"
MISTAKE = "lambda-not-halved"
SAYS = "Lambda is half of what the root is above 1: straight along the surface you see too little."


def smith_g1(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    up = np.maximum(cos, 0)
    root = np.sqrt(up * up + alpha * alpha * ((1 - up) * (1 + up)))
    return np.where(up > 0, up / np.maximum(root, 1e-30), 0).astype(cos.dtype)
