"""Depths are kept above two thousandths of a millimetre."""

import numpy as np

FUNCTION = "circle_of_confusion"
CAUGHT_BY = "near"
MISTAKE = None


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """With a mistake."""
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError(f"depth must be > 0, got {depth.min()}")
    if not aperture_radius >= 0:
        raise ValueError(f"aperture_radius must be >= 0, got {aperture_radius}")
    _check_positive("focus_distance", focus_distance)
    return (
        2 * float(aperture_radius) * np.abs(float(focus_distance) - depth) / np.maximum(depth, 2e-6)
    )
