"""A share of the mean."""

import numpy as np

FUNCTION = "needs_split"
CAUGHT_BY = "contrast"
MISTAKE = "share-of-mean"
SAYS = "You divide by the mean; contrast is a share of the largest value."


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    mean = patch_radiosity.mean(axis=1).max(axis=0)
    difference = (patch_radiosity.max(axis=1) - patch_radiosity.min(axis=1)).max(axis=0)
    return difference / np.where(mean > 0, mean, 1) > threshold
