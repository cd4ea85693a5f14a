"""A cosine below 0 makes more than all of the light: what lies beyond 0 or 1 counts as 0 or 1."""

import numpy as np

FUNCTION = "fresnel_complex"
CAUGHT_BY = "beyond"
MISTAKE = "cosine-not-clipped"
SAYS = (
    "A cosine below 0 makes more than all of the light: what lies beyond 0 or 1 counts as 0 or 1."
)


def fresnel_complex(cos, n, k):
    """With a mistake."""
    _check(1, cos=(cos, "N"), n=(n, 3), k=(k, 3))
    if not (np.minimum(n, k) >= 0).all() or not np.maximum(n, k).all():
        raise ValueError(f"n and k must be >= 0, and not both 0, got {n} and {k}")
    c = np.where(cos == 0, 1e-18, cos.astype(np.float64))
    squared = ((np.asarray(n, np.float64) + 1j * np.asarray(k, np.float64)) ** 2)[:, None]
    inside = np.sqrt(squared - (1 - c) * (1 + c))
    across, within = (c - inside) / (c + inside), (squared * c - inside) / (squared * c + inside)
    return ((np.abs(across) ** 2 + np.abs(within) ** 2) / 2).astype(cos.dtype)
