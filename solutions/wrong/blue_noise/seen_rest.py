"""You measure what the blur takes away, and not what it leaves."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "values"
MISTAKE = "what-the-blur-removes"
SAYS = "You measure what the blur takes away, and not what it leaves."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma)
    blur = np.fft.fft2(weights / weights.sum())
    seen = np.fft.ifft2(np.fft.fft2(error.astype(np.float64)) * blur).real
    seen = error.astype(np.float64) - seen
    return np.sqrt((seen**2).mean()).astype(error.dtype)
