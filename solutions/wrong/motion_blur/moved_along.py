"""Moves the rays along with the object, not against it."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "travels-along"
MISTAKE = "wrong-way"
SAYS = "You move the rays along with the object; seen from an object that moves to the right, the rest of the world moves to the left."


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    return origins + displacement(velocity, time.astype(np.result_type(origins, time)))
