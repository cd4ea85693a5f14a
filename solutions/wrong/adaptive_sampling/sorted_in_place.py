"""Sorts the caller's array."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    corners.sort(axis=1)
    return (corners[:, 3] - corners[:, 0]).max(axis=0) > threshold
