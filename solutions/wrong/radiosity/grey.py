"""The contrast of the mean of all channels."""

import numpy as np

FUNCTION = "needs_split"
CAUGHT_BY = "contrast"
MISTAKE = "grey"
SAYS = "You mix the channels first: red beside green of the same brightness is a contrast."


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    grey = patch_radiosity.mean(axis=0)
    peak = grey.max(axis=0)
    return (peak - grey.min(axis=0)) / np.where(peak > 0, peak, 1) > threshold
