"""Beyond the edges your picture is black: the blur has to go on at the opposite edge."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "edges"
MISTAKE = "nothing-beyond-the-edges"
SAYS = "Beyond the edges your picture is black: the blur has to go on at the opposite edge."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma)
    height, width = error.shape
    down, right = (np.arange(n)[:, None] - np.arange(n) for n in (height, width))
    down, right = (np.exp(-(k**2) / (2 * sigma**2)) for k in (down, right))
    seen = down @ error.astype(np.float64) @ right / weights.sum()
    return np.sqrt((seen**2).mean()).astype(error.dtype)
