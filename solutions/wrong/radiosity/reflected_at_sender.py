"""The sender's reflectance."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "fixed"
MISTAKE = "reflected-at-sender"
SAYS = "You use the reflectance of the patch that the light comes from, instead of the one that it reaches."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return emission + (reflectance * radiosity) @ form_factors.T
