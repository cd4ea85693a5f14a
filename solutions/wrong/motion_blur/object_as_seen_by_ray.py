"""Takes the difference the wrong way round."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "at-rest"
MISTAKE = "other-difference"
SAYS = "Your difference is the wrong way round: it is the object as the ray sees it, not the ray as the object sees it."


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    return displacement(velocity, time.astype(np.result_type(origins, time))) - origins
