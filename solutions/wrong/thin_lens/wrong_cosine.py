"""The distance is multiplied by the cosine instead of divided."""

import numpy as np

FUNCTION = "lens_rays"
CAUGHT_BY = "plane_in_focus"
MISTAKE = "wrong-cosine"
SAYS = "Your points in focus come nearer towards the picture's corners: the cosine belongs on the other side."


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """Rays through the point in focus."""
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    dtype = np.result_type(directions, lens_points)
    origin, right, up, forward = (np.reshape(x, (3, 1)) for x in (origin, right, up, forward))
    cos = (forward * directions).sum(axis=0)
    offset = right * lens_points[0] + up * lens_points[1]
    middle = (lens_points == 0).all(axis=0)
    origins = origin + offset
    target = origin + directions * (focus_distance * cos)
    toward = target - origins
    toward = toward / np.linalg.norm(toward, axis=0)
    toward = np.where(middle, directions, toward)
    return origins.astype(dtype), toward.astype(dtype)
