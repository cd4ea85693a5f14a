"""Objects that are nearly at the focal length have their image at infinity."""

import numpy as np

FUNCTION = "image_distance"
CAUGHT_BY = "next_to_focus"
MISTAKE = None


def image_distance(focal_length, object_distance):
    """With a mistake."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    if np.isclose(object_distance, focal_length):
        return np.inf
    f, distance = float(focal_length), float(object_distance)
    if distance == f:
        return np.inf
    if distance == np.inf:
        return f
    return f * distance / (distance - f)
