"""Points outside are moved to the surface."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "uniform"
MISTAKE = "ball-pushed-to-rim"
SAYS = "Points outside the ball are moved to its surface instead of being drawn anew, so the surface is crowded."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((3, n), np.float32) - 1
    return points / np.maximum(np.linalg.norm(points, axis=0), np.float32(1))
