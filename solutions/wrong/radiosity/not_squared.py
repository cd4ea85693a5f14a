"""Cosines forgotten: 1 / r^2 instead of 1 / r^4."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "top"
MISTAKE = "not-squared"
SAYS = "Your factors fall off with r^2 only; the two cosines bring another 1 / r^2."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = (np.arange(k) + 0.5) * 2 / k - 1
    z = x[k // 2 :, None]
    top = 4 / k**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1))
    side = 4 / k**2 * z / (np.pi * (x**2 + z**2 + 1))
    return top.astype(np.float32), side.astype(np.float32)
