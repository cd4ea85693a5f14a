"""You average absolute values: it is the root of the mean square."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "values"
MISTAKE = "mean-of-absolute-values"
SAYS = "You average absolute values: it is the root of the mean square."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma)
    blur = np.fft.fft2(weights / weights.sum())
    seen = np.fft.ifft2(np.fft.fft2(error.astype(np.float64)) * blur).real
    return np.abs(seen).mean().astype(error.dtype)
