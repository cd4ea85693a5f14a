"""Virtual images get a positive distance."""

FUNCTION = "image_distance"
CAUGHT_BY = "virtual"
MISTAKE = "always-positive"
SAYS = "You make every distance positive; a virtual image is on the object's own side, so it is negative."


def image_distance(focal_length, object_distance):
    """The lens formula."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    if object_distance == focal_length:
        return float("inf")
    if object_distance == float("inf"):
        return float(focal_length)
    return abs(1 / (1 / focal_length - 1 / object_distance))
