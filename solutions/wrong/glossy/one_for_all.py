"""One direction below mirrors the whole batch."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "unchanged"
MISTAKE = "above-one-for-all"
SAYS = "One direction below the surface mirrors all of the batch."


def keep_above(direction, normal):
    """Bring directions above the surface."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    dot = (direction * normal).sum(axis=0)
    mirrored = direction - 2 * dot * normal
    return (
        mirrored + 0 * dot
        if (dot < 0).any()
        else mirrored - 2 * (mirrored * normal).sum(axis=0) * normal
    )
