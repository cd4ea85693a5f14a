"""Compares relative contrast."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "bright"
MISTAKE = "relative"
SAYS = "You compare ratios; the threshold is for the difference itself."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    low, high = corners.min(axis=1), corners.max(axis=1)
    total = high + low
    return ((high - low) / np.where(total == 0, 1, total)).max(axis=0) > threshold
