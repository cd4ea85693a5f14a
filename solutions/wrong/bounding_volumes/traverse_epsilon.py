"""Leaves out hits nearer than a thousandth."""

import numpy as np

FUNCTION = "traverse"
CAUGHT_BY = "one"
MISTAKE = "nearest-lost"
SAYS = "You leave out hits nearer than some distance; every t over 0 is a hit, and what is near depends on the scene."

_all_hits = _intersect


def _intersect(o, d, p0, p1, p2):
    """The t of each ray at its own triangle, infinite for a miss."""
    t = _all_hits(o, d, p0, p1, p2)
    return np.where(t > 1e-3, t, t.dtype.type(np.inf))
