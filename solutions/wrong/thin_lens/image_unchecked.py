"""A negative focal length is let through."""

FUNCTION = "image_distance"
CAUGHT_BY = "refuses"
MISTAKE = "not-refused"


def image_distance(focal_length, object_distance):
    """The lens formula."""
    _check_positive("object_distance", object_distance)
    if object_distance == focal_length:
        return float("inf")
    return 1 / (1 / (focal_length or 1) - 1 / object_distance)
