"""Without saturation."""

import numpy as np

FUNCTION = "photographic"
CAUGHT_BY = "grey"
MISTAKE = "saturation-ignored"
SAYS = "The saturation does not count in your picture."


def photographic(radiance, key, burn, saturation):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("key", key, 0 < key < np.inf, "finite and > 0")
    _check_number("burn", burn, 0 <= burn <= 100, "from 0 to 100")
    _check_number("saturation", saturation, 0 <= saturation < np.inf, "finite and >= 0")
    y, mapped = luminance(radiance.astype(float)), np.zeros_like(radiance)
    lit = y > 0
    white = np.percentile(y, 100 - burn) if y.size else 0
    if white > 0:
        mean = np.exp(np.log(y[lit]).mean())
        tone, white = key * y[lit] / mean, key * white / mean
        shown = tone * (1 + tone / white / white) / (1 + tone)
        mapped[:, lit] = shown * (radiance[:, lit] / y[lit])
    return mapped
