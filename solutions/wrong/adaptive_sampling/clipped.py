"""Clips radiance to what a screen shows."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "bright"
MISTAKE = "clipped-before"
SAYS = "Radiance over 1 is cut off first, and with it the contrast of what is bright."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    corners = np.clip(corners, 0, 1)
    return (corners.max(axis=1) - corners.min(axis=1)).max(axis=0) > threshold
