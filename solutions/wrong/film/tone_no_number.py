"""Logarithms of 0."""

import numpy as np

FUNCTION = "photographic"
CAUGHT_BY = "black"
MISTAKE = "log-of-zero"
SAYS = "You take the logarithm of black pixels, or divide by their luminance."


def photographic(radiance, key, burn, saturation):
    """With a mistake."""
    _check_batch("radiance", radiance, 3)
    _check_number("key", key, 0 < key < np.inf, "finite and > 0")
    _check_number("burn", burn, 0 <= burn <= 100, "from 0 to 100")
    _check_number("saturation", saturation, 0 <= saturation < np.inf, "finite and >= 0")
    y = luminance(radiance.astype(float))
    if not y.size:
        return radiance.copy()
    with np.errstate(all="ignore"):
        tone = key * y / np.exp(np.log(y).mean())
        white = np.percentile(tone, 100 - burn)
        shown = tone * (1 + tone / white / white) / (1 + tone)
        return (shown * (radiance / y) ** saturation).astype(radiance.dtype)
