"""Lamps go out after the first iteration."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "dark"
MISTAKE = "emission-forgotten"
SAYS = "You leave out what patches emit by themselves."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return reflectance * (radiosity @ form_factors.T)
