"""Takes axes that are nearly equal for equal ones."""

import numpy as np

FUNCTION = "merge_cones"
CAUGHT_BY = "aligned"
MISTAKE = "nearly-equal-axes"
SAYS = "You take axes that are nearly equal for equal: a part of the second cone is outside."

_right = merge_cones


def merge_cones(axis_a, angle_a, axis_b, angle_b):
    """The narrowest cone around both, or around one of them."""
    same = (axis_a * axis_b).sum(axis=0) > np.cos(0.02)
    return _right(axis_a, angle_a, np.where(same, axis_a, axis_b), angle_b)
