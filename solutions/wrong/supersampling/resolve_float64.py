"""Returns float64, whatever came."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "contract"
MISTAKE = "resolve-float64"
SAYS = (
    "Your result is float64; the course's pictures are float32, and so should the result be here."
)


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    weights = np.float64(weights)
    weights = np.where(weights.sum(axis=1, keepdims=True) == 0, 1, weights)
    total = np.where(weights.sum(axis=1) == 0, 1, weights.sum(axis=1))
    return (radiance * weights).sum(axis=2) / total
