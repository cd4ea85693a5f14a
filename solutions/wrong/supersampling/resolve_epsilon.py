"""A small number is added to the weights' sum, so that small weights darken the pixel."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "scale"
MISTAKE = "small-weights-dark"
SAYS = "Pixels whose weights are all small come out too dark: you add something to the weights' sum, or take a small sum for zero."


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    return (radiance * weights).sum(axis=2) / (weights.sum(axis=1) + 1e-7)


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
