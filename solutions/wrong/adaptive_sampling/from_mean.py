"""Compares with the mean of the corners."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "any"
MISTAKE = "from-mean"
SAYS = "You compare the corners with their mean; it is the difference of two corners that counts."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return np.abs(corners - corners.mean(axis=1, keepdims=True)).max(axis=(0, 1)) > threshold
