"""Mirrored in the floor, whatever the normal."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "mirrored"
MISTAKE = "world-up"
SAYS = "You mirror in the plane z = 0, whatever the normal is."


def keep_above(direction, normal):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    direction = direction.astype(np.result_type(direction, normal))
    dot = (direction * normal).sum(axis=0)

    direction[2] = np.where(direction[2] < 0, -direction[2], direction[2])
    return direction + 0 * dot
