"""Compares all corners with the first."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "threshold"
MISTAKE = "from-first"
SAYS = "You compare all corners with one of them; the other pairs may differ more."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return np.abs(corners - corners[:, :1]).max(axis=(0, 1)) > threshold
