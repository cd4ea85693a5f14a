"""No patch receives what it sends to itself."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "hollow"
MISTAKE = None


def gather(radiosity, emission, reflectance, form_factors):
    """With a mistake."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return emission + reflectance * (radiosity @ (form_factors - np.diag(np.diag(form_factors))).T)
