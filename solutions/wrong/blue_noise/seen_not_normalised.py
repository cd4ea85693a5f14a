"""Your weights do not add up to 1: an even error grows by the blur."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "even"
MISTAKE = "weights-do-not-add-up"
SAYS = "Your weights do not add up to 1: an even error grows by the blur."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    weights = _gaussian(*error.shape, sigma)
    blur = np.fft.fft2(weights)
    seen = np.fft.ifft2(np.fft.fft2(error.astype(np.float64)) * blur).real
    return np.sqrt((seen**2).mean()).astype(error.dtype)
