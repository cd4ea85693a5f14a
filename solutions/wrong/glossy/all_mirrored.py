"""Every direction is mirrored, those above too."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "unchanged"
MISTAKE = "all-mirrored"
SAYS = "You mirror every direction, those above the surface too."


def keep_above(direction, normal):
    """Bring directions above the surface."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    direction = direction.astype(np.result_type(direction, normal))
    dot = (direction * normal).sum(axis=0)
    return direction - 2 * dot * normal
