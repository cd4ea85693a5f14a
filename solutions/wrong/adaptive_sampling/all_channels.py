"""Wants all channels to differ."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "any"
MISTAKE = "all-channels"
SAYS = "You divide where all channels differ; one is enough."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return ((corners.max(axis=1) - corners.min(axis=1)) > threshold).all(axis=0)
