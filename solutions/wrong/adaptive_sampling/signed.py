"""Forgets the absolute value of the differences."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "threshold"
MISTAKE = "sign-kept"
SAYS = "Differences keep their sign, so half of them are never over the threshold."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    pairs = [corners[:, i] - corners[:, j] for i in range(4) for j in range(i)]
    return np.max(pairs, axis=(0, 1)) > threshold if corners.size else np.zeros(0, bool)
