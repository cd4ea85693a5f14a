"""Your blur is too narrow: the 2 in 2 sigma^2 is missing."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "values"
MISTAKE = "blur-too-narrow"
SAYS = "Your blur is too narrow: the 2 in 2 sigma^2 is missing."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma / 2**0.5)
    blur = np.fft.fft2(weights / weights.sum())
    seen = np.fft.ifft2(np.fft.fft2(error.astype(np.float64)) * blur).real
    return np.sqrt((seen**2).mean()).astype(error.dtype)
