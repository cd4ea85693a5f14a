"""Black counts as a small luminance in the mean."""

import numpy as np

FUNCTION = "photographic"
CAUGHT_BY = "some_black"
MISTAKE = "black-counted"
SAYS = "Black pixels count in your logarithmic mean, as some small number."


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
        scale = key / np.exp(np.log(np.where(lit, y, 1e-6)).mean())
        tone, white = scale * y[lit], scale * white
        shown = tone * (1 + tone / white / white) / (1 + tone)
        mapped[:, lit] = shown * (radiance[:, lit] / y[lit]) ** saturation
    return mapped
