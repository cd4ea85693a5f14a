"""Added to what there is, instead of to the emission."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "fixed"
MISTAKE = "added-up"
SAYS = "You add to the radiosity so far: what was gathered before is gathered again."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return radiosity + reflectance * (radiosity @ form_factors.T)
