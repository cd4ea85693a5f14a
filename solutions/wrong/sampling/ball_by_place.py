"""Goes by the place in the batch, evenly over the shape, whatever u is."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "not-by-its-column"

_right = ball_by_polar


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    steps = np.arange(u.shape[1])[None] * np.sqrt([[2], [3], [5]])
    return _right((steps % 1).astype(u.dtype)[: len(u)])
