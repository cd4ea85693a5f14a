"""The directions above are mirrored instead of those below."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "mirrored"
MISTAKE = "wrong-way-round"
SAYS = "You mirror the directions that are above and leave those below: here the normal is on the outgoing side."


def keep_above(direction, normal):
    """Bring directions above the surface."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    direction = direction.astype(np.result_type(direction, normal))
    dot = (direction * normal).sum(axis=0)
    return np.where(dot > 0, direction - 2 * dot * normal, direction)
