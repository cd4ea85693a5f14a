"""An index of 0 is refused though there is absorption."""

import numpy as np

FUNCTION = "fresnel_complex"
CAUGHT_BY = "perfect"
MISTAKE = None


def fresnel_complex(cos, n, k):
    """With a mistake."""
    _check(1, cos=(cos, "N"), n=(n, 3), k=(k, 3))
    if not (np.minimum(n, k) >= 0).all() or not np.all(n):
        raise ValueError(f"n and k must be >= 0, and not both 0, got {n} and {k}")
    c = np.clip(cos.astype(np.float64), 1e-18, 1)
    squared = ((np.asarray(n, np.float64) + 1j * np.asarray(k, np.float64)) ** 2)[:, None]
    inside = np.sqrt(squared - (1 - c) * (1 + c))
    across, within = (c - inside) / (c + inside), (squared * c - inside) / (squared * c + inside)
    return ((np.abs(across) ** 2 + np.abs(within) ** 2) / 2).astype(cos.dtype)
