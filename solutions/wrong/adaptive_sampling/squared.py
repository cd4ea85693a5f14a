"""Compares squared differences with the threshold."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "any"
MISTAKE = "squared"
SAYS = "You compare the square of the difference with the threshold, which is for the difference itself."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return (np.ptp(corners, axis=1) ** 2).max(axis=0) > threshold
