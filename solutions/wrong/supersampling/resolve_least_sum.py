"""Weights whose sum is below 1e-8 count as none."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "scale"
MISTAKE = None


def resolve(radiance, weights):
    """With a mistake."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(
            f"weights must have shape {np.shape(radiance)[1:]}, got {np.shape(weights)}"
        )
    dtype = np.result_type(radiance, weights)
    total = np.einsum("ns->n", weights, dtype=dtype)
    unweighted = np.abs(total) < 1e-8
    if unweighted.any():
        weights = np.where(unweighted[:, None], 1, weights)
        total = np.where(unweighted, weights.shape[1], total)
    return np.einsum("cns,ns->cn", radiance, weights / total[:, None], dtype=dtype)
