"""The formula divides by zero for an object at the focal length."""

FUNCTION = "image_distance"
CAUGHT_BY = "limits"
MISTAKE = "limits"
SAYS = "Your formula is right, but it breaks where a distance or a difference is infinite or zero."


def image_distance(focal_length, object_distance):
    """The lens formula."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    return focal_length * object_distance / (object_distance - focal_length)
