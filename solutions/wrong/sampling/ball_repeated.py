"""What is accepted of n candidates, some of it twice."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "acceptance"
MISTAKE = "ball-repeated"
SAYS = "You fill up with points that you have already: in the place of each that was rejected another has to be drawn."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((3, n), np.float32) - 1
    points = points[:, np.linalg.norm(points, axis=0) <= 1]
    return points[:, np.arange(n) % max(1, points.shape[1])]
