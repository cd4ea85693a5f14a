"""Contrasts of what a screen shows."""

import numpy as np

FUNCTION = "needs_split"
CAUGHT_BY = "scale"
MISTAKE = "split-clipped"
SAYS = (
    "You clip the radiosity to [0, 1] before you compare: bright patches have their contrasts, too."
)


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    shown = np.clip(patch_radiosity, 0, 1)
    high = shown.max(axis=1)
    difference = (high - shown.min(axis=1)).max(axis=0)
    peak = high.max(axis=0)
    return difference / np.where(peak > 0, peak, 1) > threshold
