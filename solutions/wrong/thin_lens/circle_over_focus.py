"""Divided by the distance in focus instead of the depth."""

import numpy as np

FUNCTION = "circle_of_confusion"
CAUGHT_BY = "behind"
MISTAKE = "relative-to-focus"
SAYS = "You divide by the distance in focus; the similar triangles have their tip at the point."


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """The diameter of the circle."""
    _check_depth(depth, aperture_radius, focus_distance)
    with np.errstate(all="ignore"):
        largest = np.finfo(depth.dtype).max
        focus = depth.dtype.type(focus_distance)
        aperture = depth.dtype.type(aperture_radius)
        return np.minimum(2 * aperture * np.abs(focus - depth) / focus, largest)


def _check_depth(depth, aperture_radius, focus_distance):
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError("depth must be > 0")
    if not aperture_radius >= 0:
        raise ValueError("aperture_radius must be >= 0")
    _check_positive("focus_distance", focus_distance)
