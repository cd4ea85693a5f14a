"""Sides without the cosine at the patch."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "side"
MISTAKE = "height-forgotten"
SAYS = "Your sides lack the cosine at the patch, which is smaller the lower the cell is."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    cell = 2 / k
    x = (np.arange(k) + 0.5) * cell - 1
    z = x[k // 2 :, None]
    top = cell**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1) ** 2)
    side = cell**2 / (np.pi * (x**2 + z**2 + 1) ** 2)
    return top.astype(np.float32), side.astype(np.float32)
