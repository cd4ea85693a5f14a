"""From the cells' lower corners instead of their centres."""

import numpy as np

FUNCTION = "hemicube_form_factors"
CAUGHT_BY = "top"
MISTAKE = "hemicube-corners"
SAYS = "The form factors are those of the cells' corners, not of their centres."


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = np.arange(k) * 2 / k - 1
    z = x[k // 2 :, None]
    top = 4 / k**2 / (np.pi * (x**2 + x[:, None] ** 2 + 1) ** 2)
    side = 4 / k**2 * z / (np.pi * (x**2 + z**2 + 1) ** 2)
    return top.astype(np.float32), side.astype(np.float32)
