"""Compares luminances, green the most."""

import numpy as np

FUNCTION = "needs_subdivision"
CAUGHT_BY = "any"
MISTAKE = "luminance"
SAYS = "Luminances are compared: what differs in blue or red alone is hardly seen."


def needs_subdivision(corners, threshold):
    """Which cells to divide."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    weights = np.array((0.2126, 0.7152, 0.0722), corners.dtype)
    return np.ptp(np.einsum("c,ckn->kn", weights, corners), axis=0) > threshold
