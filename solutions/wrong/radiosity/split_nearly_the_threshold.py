"""Contrasts that are nearly the threshold count as it."""

import numpy as np

FUNCTION = "needs_split"
CAUGHT_BY = "just_over"
MISTAKE = None


def needs_split(patch_radiosity, threshold):
    """With a mistake."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    brightest = patch_radiosity.max(axis=1)
    difference = (brightest - patch_radiosity.min(axis=1)).max(axis=0)
    peak = brightest.max(axis=0)
    contrast = difference / np.where(peak > 0, peak, 1)
    return (contrast > threshold) & ~np.isclose(contrast, threshold)
