"""The uniform directions."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "uniform-for-cosine"
SAYS = "Your directions are uniform: those near the horizon come as often as those near the pole."


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    return uniform_hemisphere(u)
