"""Compares corners along the sides only."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "threshold"
MISTAKE = "adjacent-only"
SAYS = "You compare corners along the cell's sides only; an edge may run between the other two."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    around = corners[:, [0, 1, 3, 2]]
    return np.abs(around - np.roll(around, 1, axis=1)).max(axis=(0, 1)) > threshold
