"""The plain mean: the weights are not used."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "mean"
MISTAKE = "weights-ignored"
SAYS = "All your samples count alike: the weights are not used."


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    total = radiance.sum(axis=2) / max(radiance.shape[2], 1)
    return total.astype(np.result_type(radiance, weights))


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
