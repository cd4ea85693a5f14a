"""The uniform directions."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "uniform-for-cosine"


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    return uniform_hemisphere(u)
