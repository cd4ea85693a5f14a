"""Points all but on the lens get an infinite circle."""

import numpy as np

FUNCTION = "circle_of_confusion"
CAUGHT_BY = "overflow"
MISTAKE = None


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """The diameter of the circle."""
    _check_depth(depth, aperture_radius, focus_distance)
    with np.errstate(over="ignore"):
        spread = np.abs(depth.dtype.type(focus_distance) - depth) / depth
        return depth.dtype.type(2 * aperture_radius) * spread


def _check_depth(depth, aperture_radius, focus_distance):
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError("depth must be > 0")
    if not aperture_radius >= 0:
        raise ValueError("aperture_radius must be >= 0")
    _check_positive("focus_distance", focus_distance)
