"""Clips the radiosity to 1."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "values"
MISTAKE = "gather-clipped"
SAYS = "You clip the radiosity to [0, 1]: light may have any size."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return np.clip(emission + reflectance * (radiosity @ form_factors.T), 0, 1)
