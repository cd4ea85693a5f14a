"""The angle between the axes is the arcus cosine of a product in float32, which has half of the digits."""

import numpy as np

FUNCTION = "merge_cones"
CAUGHT_BY = "narrow"
MISTAKE = None


def merge_cones(axis_a, angle_a, axis_b, angle_b):
    """With a mistake."""
    dtype = np.result_type(axis_a, angle_a, axis_b, angle_b)
    _check("axis_a", axis_a, 3, "N")
    count = np.shape(axis_a)[1]
    _check("angle_a", angle_a, count)
    _check("axis_b", axis_b, 3, count)
    _check("angle_b", angle_b, count)
    a, b = axis_a.astype(dtype), axis_b.astype(dtype)
    swap = angle_b > angle_a
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    wide, narrow = np.maximum(angle_a, angle_b), np.minimum(angle_a, angle_b)
    across = b - _dot(a, b) * a
    sine = np.sqrt(_dot(across, across))
    apart = np.arccos(np.clip(_dot(a, b), -1, 1))
    inside = np.minimum(apart + narrow, np.pi) <= wide
    angle = np.where(inside, wide, np.minimum((apart + wide + narrow) / 2, np.pi))
    other = np.eye(3)[:, np.abs(a).argmin(axis=0)]
    other = other - _dot(a, other) * a
    across = np.where(sine > 1e-9, across, other)
    across = across / np.sqrt(_dot(across, across))
    turn = np.where(inside | (angle >= np.pi), 0, angle - wide)
    axis = np.cos(turn) * a + np.sin(turn) * across
    axis /= np.sqrt(_dot(axis, axis))
    return axis.astype(dtype), np.minimum(angle.astype(dtype), dtype.type(np.pi))
