"""Directions below are mirrored in the caller's array."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def keep_above(direction, normal):
    """Bring directions above the surface."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    dot = (direction * normal).sum(axis=0)
    below = dot < 0
    direction[:, below] -= 2 * (dot * normal)[:, below]
    return direction.astype(np.result_type(direction, normal))
