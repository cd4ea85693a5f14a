"""Differences that are nearly the threshold count as it."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "just_over"
MISTAKE = None


def needs_subdivision(corners, threshold):
    """With a mistake."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    contrast = corners.max(axis=1) - corners.min(axis=1)
    return (contrast.max(axis=0) > threshold) & ~np.isclose(contrast.max(axis=0), threshold)
