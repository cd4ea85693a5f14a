"""The cosine's directions."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "cosine-for-uniform"


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    return cosine_hemisphere(u)
