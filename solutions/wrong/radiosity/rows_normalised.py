"""Form factors are scaled so that each row sums to 1."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "values"
MISTAKE = "rows-normalised"
SAYS = "Each row of form factors is scaled to sum to 1: rooms that are open lose no light then."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    total = form_factors.sum(axis=1, keepdims=True)
    shares = form_factors / np.where(total > 0, total, 1)
    return emission + reflectance * (radiosity @ shares.T)
