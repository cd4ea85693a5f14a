"""The origins move and the directions stay."""

import numpy as np

FUNCTION = "lens_rays"
CAUGHT_BY = "plane_in_focus"
MISTAKE = "unchanged-directions"
SAYS = "You move the origins but keep the pinhole's directions, so nothing is in focus."


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """Rays through the point in focus."""
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    dtype = np.result_type(directions, lens_points)
    origin, right, up, forward = (np.reshape(x, (3, 1)) for x in (origin, right, up, forward))
    offset = right * lens_points[0] + up * lens_points[1]
    toward = directions * np.ones_like(lens_points[0])
    return (origin + offset).astype(dtype), toward.astype(dtype)
