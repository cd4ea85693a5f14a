"""You give the mean square: its root is left out."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "values"
MISTAKE = "root-left-out"
SAYS = "You give the mean square: its root is left out."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma)
    blur = np.fft.fft2(weights / weights.sum())
    seen = np.fft.ifft2(np.fft.fft2(error.astype(np.float64)) * blur).real
    return (seen**2).mean().astype(error.dtype)
