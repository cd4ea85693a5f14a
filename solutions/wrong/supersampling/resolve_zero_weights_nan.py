"""Zero divided by zero where all weights of a pixel are zero."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "zero-weights"
MISTAKE = "zero-weights-nan"
SAYS = "Where all weights of a pixel are zero you divide zero by zero."


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    with np.errstate(invalid="ignore", divide="ignore"):
        return (radiance * weights).sum(axis=2) / weights.sum(axis=1)


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
