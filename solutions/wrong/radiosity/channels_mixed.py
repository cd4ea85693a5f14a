"""All channels reflect by their mean reflectance."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "values"
MISTAKE = "mean-reflectance"
SAYS = "All channels reflect by the mean of their reflectances."


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    return (emission + reflectance.mean(axis=0) * (radiosity @ form_factors.T)).astype(
        np.result_type(emission, reflectance, radiosity, form_factors)
    )
