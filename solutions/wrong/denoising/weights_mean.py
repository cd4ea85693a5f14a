"""You compare means over the channels; one of them is enough to separate two pixels."""

import numpy as np

FUNCTION = "pair_weights"
CAUGHT_BY = "channel"
MISTAKE = "mean-over-channels"
SAYS = "You compare means over the channels; one of them is enough to separate two pixels."


def pair_weights(t, critical, distance, sigma):
    """With a mistake."""
    _check("t", t, 3, "N")
    pixels = np.shape(t)[1]
    _check("critical", critical, 3, pixels)
    _check("distance", distance, pixels)
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    joined = np.abs(t).mean(axis=0) <= critical.mean(axis=0)
    weights = joined * np.exp(-0.5 * (distance / sigma) ** 2)
    return weights.astype(_dtype(t, critical, distance))
