"""What patches emit is reflected by themselves, too."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "dark"
MISTAKE = "emission-reflected"
SAYS = "You multiply what patches emit by themselves by their reflectance; only what arrives is reflected."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return reflectance * (emission + radiosity @ form_factors.T)
