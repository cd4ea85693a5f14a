"""Writes the result into the radiosity."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    radiosity[:] = emission + reflectance * (radiosity @ form_factors.T)
    return radiosity.astype(np.result_type(radiosity, emission, reflectance, form_factors))
