"""Plain Python, one ray at a time, in double precision."""

import numpy as np


def point_on_disk(u):
    """The first number for the angle, the second for the radius."""
    _check_batch("u", u, 2)
    points = np.empty_like(u)
    for i in range(u.shape[1]):
        r = (1 - float(u[1, i])) ** 0.5
        phi = -2 * np.pi * float(u[0, i])
        points[:, i] = r * np.sin(phi), r * np.cos(phi)
    return points


def lens_rays(origin, right, up, forward, directions, lens_points, focus_distance):
    """The plane in focus intersected with the pinhole's ray."""
    _check_single(origin=origin, right=right, up=up, forward=forward)
    _check_batch("directions", directions, 3)
    _check_batch("lens_points", lens_points, 2, np.shape(directions)[1])
    _check_positive("focus_distance", focus_distance)
    dtype = np.result_type(directions, lens_points)
    origin, right, up, forward = (np.array(x, float) for x in (origin, right, up, forward))
    origins = np.empty(directions.shape, dtype)
    toward = np.empty(directions.shape, dtype)
    for i in range(directions.shape[1]):
        d = directions[:, i].astype(float)
        x, y = lens_points[:, i].astype(float)
        start = origin + x * right + y * up
        origins[:, i] = start
        if x == 0 and y == 0:
            toward[:, i] = directions[:, i]
            continue
        ray = origin + d * (focus_distance / (forward @ d)) - start
        toward[:, i] = ray / (ray @ ray) ** 0.5
    return origins, toward


def image_distance(focal_length, object_distance):
    """By the powers of the lens and of the object's distance."""
    _check_positive("focal_length", focal_length)
    _check_positive("object_distance", object_distance)
    power = 1 / float(focal_length) - 1 / float(object_distance)
    return 1 / power if power != 0 else float("inf")


def circle_of_confusion(depth, aperture_radius, focus_distance):
    """One depth at a time."""
    _check_depth(depth, aperture_radius, focus_distance)
    largest = float(np.finfo(depth.dtype).max)
    result = np.empty_like(depth)
    for i, z in enumerate(depth.tolist()):
        result[i] = min(2 * float(aperture_radius) * abs(focus_distance / z - 1), largest)
    return result


def _check_depth(depth, aperture_radius, focus_distance):
    if np.ndim(depth) != 1:
        raise ValueError(f"depth must have shape (N,), got {np.shape(depth)}")
    if not (depth > 0).all():
        raise ValueError("depth must be > 0")
    if not aperture_radius >= 0:
        raise ValueError("aperture_radius must be >= 0")
    _check_positive("focus_distance", focus_distance)
