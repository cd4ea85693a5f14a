"""Two pixels at one place are never separated."""

import numpy as np

FUNCTION = "pair_weights"
CAUGHT_BY = "channel"
MISTAKE = None

_right = pair_weights


def pair_weights(t, critical, distance, sigma):
    """With a mistake."""
    return np.where(distance == 0, 1, _right(t, critical, distance, sigma)).astype(
        np.result_type(t, critical, distance)
    )
