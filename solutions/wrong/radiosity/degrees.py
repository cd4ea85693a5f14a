"""Cosines of angles that are taken for degrees."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "top"
MISTAKE = "hemicube-degrees"
SAYS = "Cosines of angles are taken as if the angles were degrees."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = (np.arange(k) + 0.5) * 2 / k - 1
    z = x[k // 2 :, None]
    on_top = np.degrees(np.arctan(np.sqrt(x**2 + x[:, None] ** 2)))
    top = 4 / k**2 / np.pi * np.cos(on_top) ** 4
    side = 4 / k**2 * z / (np.pi * (x**2 + z**2 + 1) ** 2)
    return top.astype(np.float32), side.astype(np.float32)
