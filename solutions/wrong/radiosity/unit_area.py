"""Cells of a top of 1 x 1 with the directions of 2 x 2."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "sum"
MISTAKE = "unit-area"
SAYS = "Your cells have a fourth of their area: the top is 2 x 2, not 1 x 1."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = (np.arange(k) + 0.5) * 2 / k - 1
    z = x[k // 2 :, None]
    top = 1 / k**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1) ** 2)
    side = 1 / k**2 * z / (np.pi * (x**2 + z**2 + 1) ** 2)
    return top.astype(np.float32), side.astype(np.float32)
