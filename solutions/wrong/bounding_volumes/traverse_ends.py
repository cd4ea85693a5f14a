"""Ends a thousand units away."""

import numpy as np

FUNCTION = "traverse"
CAUGHT_BY = "large"
MISTAKE = "far-lost"
SAYS = "You find nothing beyond some distance; a ray goes on for ever."

_all_hits = _intersect


def _intersect(o, d, p0, p1, p2):
    """The t of each ray at its own triangle, infinite for a miss."""
    t = _all_hits(o, d, p0, p1, p2)
    return np.where(t < 1000, t, t.dtype.type(np.inf))
