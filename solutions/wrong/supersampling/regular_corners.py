"""Points at the corners of the cells, not in their middle."""

import numpy as np

FUNCTION = "regular"
CAUGHT_BY = "centres"
MISTAKE = "corners-of-cells"
SAYS = "Your points stand at the corners of the cells; they belong in the middle of each."


def regular(k, n):
    """Centres of a k x k grid."""
    _check_counts(k, n)
    x = np.arange(k) / k
    xs, ys = np.meshgrid(x, x)
    one = np.array([xs.ravel(), ys.ravel()], dtype=np.float32)
    return np.repeat(one[:, None, :], n, axis=1)
