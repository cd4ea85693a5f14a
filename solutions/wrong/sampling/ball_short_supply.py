"""As many candidates as are enough on average; where they aren't, the first points come again."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "supply"
MISTAKE = None


def ball_by_rejection(n, rng):
    """With a mistake."""
    _check_count(n)
    points = rng.uniform(-1, 1, (3, 2 * n + 10)).astype(np.float32)
    points = points[:, (points * points).sum(axis=0) <= 1]
    return points[:, np.arange(n) % max(1, points.shape[1])]
