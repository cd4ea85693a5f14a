"""Directions below are turned round as a whole."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "mirrored"
MISTAKE = "flipped"
SAYS = "You turn the whole direction round; only its part along the normal changes sign."


def keep_above(direction, normal):
    """Bring directions above the surface."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    direction = direction.astype(np.result_type(direction, normal))
    dot = (direction * normal).sum(axis=0)
    return np.where(dot < 0, -direction, direction)
