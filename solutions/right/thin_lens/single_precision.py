"""Single precision throughout, through the point in focus in the world."""

import numpy as np


def point_on_disk(u):
    """Rows swapped, both the other way round."""
    _check_batch("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * (1 - u[0])
    return np.sqrt(1 - u[1]) * np.stack((np.sin(phi), np.cos(phi)))


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """From the origin on the lens to the point in focus, both in the world."""
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    dtype = np.result_type(directions, lens_points)
    origin, right, up, forward = (
        np.asarray(x, dtype)[:, None] for x in (origin, right, up, forward)
    )
    t = dtype.type(focus_distance) / (forward * directions).sum(axis=0)
    offset = right * lens_points[0] + up * lens_points[1]
    toward = t * directions - offset
    toward /= np.linalg.norm(toward, axis=0)
    exact = np.where((lens_points == 0).all(axis=0), directions, toward)
    return (origin + offset).astype(dtype), exact.astype(dtype)


def image_distance(focal_length, object_distance):
    """The product over the difference."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    if np.isinf(object_distance):
        return float(focal_length)
    if focal_length == object_distance:
        return np.inf
    return float(focal_length * object_distance / (object_distance - focal_length))


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """Two cases, as drawn in the text."""
    _check_depth(depth, aperture_radius, focus_distance)
    focus, diameter = depth.dtype.type(focus_distance), depth.dtype.type(2 * aperture_radius)
    with np.errstate(over="ignore"):
        behind = diameter * ((depth - focus) / depth)
        in_front = diameter * ((focus - depth) / depth)
    largest = np.finfo(depth.dtype).max
    return np.clip(np.where(depth > focus, behind, in_front), 0, largest)


def _check_depth(depth, aperture_radius, focus_distance):
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError("depth must be > 0")
    if not aperture_radius >= 0:
        raise ValueError("aperture_radius must be >= 0")
    _check_positive("focus_distance", focus_distance)
