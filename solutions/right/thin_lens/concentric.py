"""Shirley and Chiu's disk, and the lens in the camera's own coordinates."""

import numpy as np


def point_on_disk(u):
    """Rings of squares to rings of circles."""
    _check_batch("u", u, 2)
    x, y = 2 * u - 1
    wide = np.abs(x) > np.abs(y)
    r = np.where(wide, x, y)
    safe = np.where(r == 0, 1, r)
    quarter = u.dtype.type(np.pi / 4)
    phi = np.where(wide, quarter * (y / safe), 2 * quarter - quarter * (x / safe))
    return np.stack((r * np.cos(phi), r * np.sin(phi))).astype(u.dtype)


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """In coordinates in which the lens looks along z."""
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    dtype = np.result_type(directions, lens_points)
    axes = np.array([right, up, forward], np.float64)
    local = axes @ directions
    on_lens = np.concatenate((lens_points, np.zeros_like(lens_points[:1])))
    toward = local / local[2] - on_lens / np.float64(focus_distance)
    toward = axes.T @ (toward / np.sqrt((toward * toward).sum(axis=0)))
    middle = (lens_points == 0).all(axis=0)
    toward = np.where(middle, directions, toward)
    origins = np.reshape(np.asarray(origin, np.float64), (3, 1)) + axes.T @ on_lens
    return origins.astype(dtype), toward.astype(dtype)


def image_distance(focal_length, object_distance):
    """By Newton's form: distances from the foci multiply to the focal length's square."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    beyond = object_distance - focal_length
    if beyond == 0:
        return float("inf")
    return float(focal_length + focal_length * (focal_length / beyond))


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """In double precision, cast at the end."""
    _check_depth(depth, aperture_radius, focus_distance)
    with np.errstate(over="ignore"):
        exact = 2 * float(aperture_radius) * np.abs(1 - focus_distance / depth.astype(np.float64))
    return np.minimum(exact, np.finfo(depth.dtype).max).astype(depth.dtype)


def _check_depth(depth, aperture_radius, focus_distance):
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError("depth must be > 0")
    if not aperture_radius >= 0:
        raise ValueError("aperture_radius must be >= 0")
    _check_positive("focus_distance", focus_distance)
