"""A top half as high: the hemicube of a base of 4 x 4."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "cells"
MISTAKE = "low-top"
SAYS = "The hemicube's top is at half its height."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = (np.arange(k) + 0.5) * 4 / k - 2
    z = x[k // 2 :, None] / 2
    top = 16 / k**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1) ** 2)
    side = 16 / k**2 * z / (np.pi * (x**2 + z**2 + 4) ** 2) * 2
    return top.astype(np.float32), side.astype(np.float32)
