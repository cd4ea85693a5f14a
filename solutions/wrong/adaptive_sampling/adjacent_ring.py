"""Compares each corner with the next, and the last with the first."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "threshold"
MISTAKE = "adjacent-only"


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return np.abs(corners - np.roll(corners, 1, axis=1)).max(axis=(0, 1)) > threshold
