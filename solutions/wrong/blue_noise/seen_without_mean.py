"""You take the mean away first: an error that is the same everywhere counts."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "even"
MISTAKE = "mean-left-out"
SAYS = "You take the mean away first: an error that is the same everywhere counts."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma)
    blur = np.fft.fft2(weights / weights.sum())
    seen = np.fft.ifft2(np.fft.fft2(error.astype(np.float64)) * blur).real
    return np.sqrt(seen.var()).astype(error.dtype)
