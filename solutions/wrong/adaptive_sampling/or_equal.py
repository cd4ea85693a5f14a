"""Divides at the threshold too."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "threshold"
MISTAKE = "or-equal"
SAYS = "You divide cells whose difference is the threshold itself; it has to be over it."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return (corners.max(axis=1) - corners.min(axis=1)).max(axis=0) >= threshold
