"""Columns of the form factors for rows."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "values"
MISTAKE = "transposed"
SAYS = "You take columns of the form factors for rows: they tell what others send, not what arrives per area."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return emission + reflectance * (radiosity @ form_factors)
