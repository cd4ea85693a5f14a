"""Parts of a column are kept above a millionth."""

import numpy as np

FUNCTION = "draw_alias"
CAUGHT_BY = "narrow"
MISTAKE = None


def draw_alias(probability, alias, u):
    """With a mistake."""
    if np.ndim(probability) != 1:
        raise ValueError(f"probability must have shape (K,), got {np.shape(probability)}")
    if np.shape(alias) != np.shape(probability):
        raise ValueError(f"alias must have shape {np.shape(probability)}, got {np.shape(alias)}")
    if np.ndim(u) != 1:
        raise ValueError(f"u must have shape (N,), got {np.shape(u)}")
    place = np.asarray(u, np.float64) * len(probability)
    column = np.minimum(place.astype(np.intp), len(probability) - 1)
    fraction, own = place - column, probability[column]
    kept = fraction < own
    share = np.where(kept, own, 1 - own)
    rest = np.where(kept, fraction, fraction - own) / np.maximum(share, 1e-6)
    return np.where(kept, column, alias[column]), rest.astype(u.dtype)
