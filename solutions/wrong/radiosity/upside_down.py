"""Sides from the top's edge downwards."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "side"
MISTAKE = "upside-down"
SAYS = "Your sides are upside down: row 0 is the lowest."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = (np.arange(k) + 0.5) * 2 / k - 1
    z = x[: k // 2 - 1 : -1, None]
    top = 4 / k**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1) ** 2)
    side = 4 / k**2 * z / (np.pi * (x**2 + z**2 + 1) ** 2)
    return top.astype(np.float32), side.astype(np.float32)
