"""In rooms of three patches and fewer form factors are read the other way round."""

import numpy as np

FUNCTION = "gather"
CAUGHT_BY = "few"
MISTAKE = None

_right = gather


def gather(radiosity, emission, reflectance, form_factors):
    """With a mistake."""
    few = np.ndim(form_factors) == 2 and len(form_factors) <= 3
    return _right(radiosity, emission, reflectance, form_factors.T if few else form_factors)
