"""Takes small triangles for ones that are seen edge-on."""

import numpy as np

FUNCTION = "traverse"
CAUGHT_BY = "small"
MISTAKE = "small-lost"
SAYS = "You lose small triangles: a determinant grows with the square of the edges, so no fixed number says what is flat."

_all_hits = _intersect


def _intersect(o, d, p0, p1, p2):
    """The t of each ray at its own triangle, infinite for a miss."""
    t = _all_hits(o, d, p0, p1, p2)
    return np.where(np.abs(_dot(p1 - p0, _cross(d, p2 - p0))) > 1e-6, t, t.dtype.type(np.inf))
