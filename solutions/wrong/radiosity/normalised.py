"""Scaled so that the sum is exactly 1, though the cells are right only nearly."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "top"
MISTAKE = "hemicube-normalised"
SAYS = "All form factors are scaled so that their sum is 1: it isn't for cells of finite size."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = (np.arange(k) + 0.5) * 2 / k - 1
    z = x[k // 2 :, None]
    top = 4 / k**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1) ** 2)
    side = 4 / k**2 * z / (np.pi * (x**2 + z**2 + 1) ** 2)
    total = top.sum() + 4 * side.sum()
    return (top / total).astype(np.float32), (side / total).astype(np.float32)
