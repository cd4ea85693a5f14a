"""Returns float64, as NumPy works by itself."""

import numpy as np

FUNCTION = "regular"
CAUGHT_BY = "contract"
MISTAKE = "regular-float64"
SAYS = (
    "Your result is float64; the course's pictures are float32, and so should the result be here."
)


def regular(k, n):
    """Centres of a k x k grid."""
    _check_counts(k, n)
    centre = (np.arange(k) + 0.5) / k
    xs, ys = np.meshgrid(centre, centre)
    return np.repeat(np.stack((xs, ys)).reshape(2, 1, -1), n, axis=1)
