"""Black where all weights of a pixel are zero."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "zero-weights"
MISTAKE = "zero-weights-black"
SAYS = (
    "Where all weights of a pixel are zero your pixel is black; it should be the plain mean there."
)


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    total = weights.sum(axis=1)
    safe = np.where(total == 0, 1, total)
    return np.where(total == 0, 0, (radiance * weights).sum(axis=2) / safe)


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
