"""The difference is the wrong way round."""

FUNCTION = "image_distance"
CAUGHT_BY = "real"
MISTAKE = "wrong-sign"
SAYS = "Your sign is the wrong way round: real images are positive, virtual ones negative."


def image_distance(focal_length, object_distance):
    """The lens formula."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    if object_distance == focal_length:
        return float("inf")
    if object_distance == float("inf"):
        return float(focal_length)
    return 1 / (1 / object_distance - 1 / focal_length)
