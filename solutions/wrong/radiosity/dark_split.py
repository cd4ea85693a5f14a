"""Black patches are divided: 0 / 0 is taken for a contrast."""

import numpy as np

FUNCTION = "needs_split"
CAUGHT_BY = "dark"
MISTAKE = "dark-split"
SAYS = "Patches without light are divided: the contrast of nothing is 0."


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    high = patch_radiosity.max(axis=1)
    difference = (high - patch_radiosity.min(axis=1)).max(axis=0)
    peak = high.max(axis=0)
    return np.where(peak > 0, difference / np.where(peak > 0, peak, 1), 1) > threshold
