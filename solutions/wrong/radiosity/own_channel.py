"""Each channel by its own largest value."""

import numpy as np

FUNCTION = "needs_split"
CAUGHT_BY = "contrast"
MISTAKE = "own-channel"
SAYS = "You compare each channel with its own largest value; a dark one has much contrast and little light."


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    high, low = patch_radiosity.max(axis=1), patch_radiosity.min(axis=1)
    return ((high - low) / np.where(high > 0, high, 1) > threshold).any(axis=0)
