"""The cosine to the axis is kept above 0.2, so that nothing is divided by 0."""

import numpy as np

FUNCTION = "lens_rays"
CAUGHT_BY = "extremes"
MISTAKE = None


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """With a mistake."""
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    dtype = np.result_type(directions, lens_points)
    lens = np.outer(right, lens_points[0]) + np.outer(up, lens_points[1])
    toward = directions * (focus_distance / np.maximum(forward @ directions, 0.2)) - lens
    toward /= np.linalg.norm(toward, axis=0)
    return (np.reshape(origin, (3, 1)) + lens).astype(dtype), toward.astype(dtype)
