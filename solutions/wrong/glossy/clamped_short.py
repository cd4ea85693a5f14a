"""Pressed flat, and not brought back to length 1."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "mirrored"
MISTAKE = "clamped"


def keep_above(direction, normal):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    direction = direction.astype(np.result_type(direction, normal))
    dot = (direction * normal).sum(axis=0)
    return direction - np.minimum(dot, 0) * normal
