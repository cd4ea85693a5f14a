"""The reciprocals are added instead of subtracted."""

FUNCTION = "image_distance"
CAUGHT_BY = "real"
MISTAKE = "added"
SAYS = "You add the reciprocal of the object's distance where the lens formula has a difference."


def image_distance(focal_length, object_distance):
    """The lens formula."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    if object_distance == focal_length:
        return float("inf")
    if object_distance == float("inf"):
        return float(focal_length)
    return 1 / (1 / focal_length + 1 / object_distance)
