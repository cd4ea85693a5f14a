"""Everything is reflected."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "values"
MISTAKE = "reflectance-forgotten"
SAYS = "You leave out the reflectance: patches return all light that reaches them."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return emission + radiosity @ form_factors.T
