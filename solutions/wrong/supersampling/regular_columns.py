"""Cells column by column: y grows first."""

import numpy as np

FUNCTION = "regular"
CAUGHT_BY = "order"
MISTAKE = "regular-columns"
SAYS = "Your cells come column by column; x should grow first, then y."


def regular(k, n):
    """Centres of a k x k grid."""
    _check_counts(k, n)
    centre = (np.arange(k) + 0.5) / k
    xs, ys = np.meshgrid(centre, centre, indexing="ij")
    one = np.stack([xs.ravel(), ys.ravel()]).astype(np.float32)
    return np.tile(one[:, None], (1, n, 1))
