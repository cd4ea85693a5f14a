"""One edge divides all cells."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "any"
MISTAKE = "one-for-all"
SAYS = "One cell with an edge makes you divide all of them; each is decided on its own."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    contrast = corners.max(axis=1) - corners.min(axis=1)
    return np.full(corners.shape[2], bool((contrast > threshold).any()))
