"""The cosine's directions."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "cosine-for-uniform"
SAYS = "Your directions have the density cos / pi instead of a constant one."


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    return cosine_hemisphere(u)
