"""The weighted sum, never divided."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "mean"
MISTAKE = "sum-not-mean"
SAYS = (
    "You sum the weighted samples but never divide, so pixels brighten with the number of samples."
)


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    return (radiance * weights).sum(axis=2)


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
