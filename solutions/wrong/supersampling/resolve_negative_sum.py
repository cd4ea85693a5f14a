"""A sum of weights below 0 is taken for none."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "negative-weights"
MISTAKE = "negative-sum-is-none"
SAYS = "Weights whose sum is below 0 are treated like weights that sum to 0."

_right = resolve


def resolve(radiance, weights):
    """The plain mean where the weights' sum isn't over 0."""
    found = _right(radiance, weights)
    below = weights.sum(axis=1) < 0
    return np.where(below, _right(radiance, np.ones_like(weights)), found).astype(found.dtype)
