"""Pixels below a luminance of 1e-9 count as black."""

import numpy as np

FUNCTION = "photographic"
CAUGHT_BY = "faint"
MISTAKE = None


def photographic(radiance, key, burn, saturation):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("key", key, 0 < key < np.inf, "finite and > 0")
    _check_number("burn", burn, 0 <= burn <= 100, "from 0 to 100")
    _check_number("saturation", saturation, 0 <= saturation < np.inf, "finite and >= 0")
    y, mapped = luminance(radiance.astype(np.float64)), np.zeros_like(radiance)
    lit, white = y > 1e-9, np.percentile(y, 100 - burn) if y.size else 0
    if white > 1e-9:
        scale = key / np.exp(np.log(y[lit]).mean())
        tone = scale * y[lit]
        shown = tone * (1 + tone / (scale * white) ** 2) / (1 + tone)
        mapped[:, lit] = shown * (radiance[:, lit] / y[lit]) ** saturation
    return mapped
