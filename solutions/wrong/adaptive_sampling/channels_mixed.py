"""Compares channels with each other."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "plain"
MISTAKE = "channels-mixed"
SAYS = "You compare one channel with another: a plain red cell is smooth."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return corners.max(axis=(0, 1)) - corners.min(axis=(0, 1)) > threshold
