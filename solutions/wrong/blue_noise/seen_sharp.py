"""You take the RMSE of the sharp error: a blur of its squares changes nothing."""

import numpy as np

FUNCTION = "perceptual_rmse"
CAUGHT_BY = "values"
MISTAKE = "not-blurred"
SAYS = "You take the RMSE of the sharp error: a blur of its squares changes nothing."


def perceptual_rmse(error, sigma):
    """With a mistake."""
    _check_picture("error", error)
    _check_sigma(sigma)
    seen = error.astype(np.float64)
    return np.sqrt((seen**2).mean()).astype(error.dtype)
