"""Plain Python loops, one point after the other."""

import math

import numpy as np


def light_grid(corner, edge_u, edge_v, k):
    """Column by column, from the far end."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    points = np.zeros((3, k * k), np.float32)
    number = 0
    for i in range(k):
        for j in reversed(range(k)):
            for axis in range(3):
                a, b = float(edge_u[axis]), float(edge_v[axis])
                points[axis, number] = corner[axis] + a * (i + 0.5) / k + b * (j + 0.5) / k
            number += 1
    return points


def point_on_rectangle(corner, edge_u, edge_v, u):
    """The second number along the first edge."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    points = np.zeros((3, u.shape[1]), u.dtype)
    for i in range(u.shape[1]):
        b, a = float(u[0, i]), float(u[1, i])
        for axis in range(3):
            points[axis, i] = corner[axis] + float(edge_u[axis]) * a + float(edge_v[axis]) * b
    return points


def point_on_sphere(center, radius, u):
    """The polar angle from its cosine."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)
    points = np.zeros((3, u.shape[1]), u.dtype)
    for i in range(u.shape[1]):
        offset = _direction(float(u[0, i]), float(u[1, i]))
        points[:, i] = [float(c) + float(radius) * o for c, o in zip(center, offset, strict=True)]
    return points


def point_in_ball(center, radius, u):
    """The largest of three independent numbers, from one, has the distance's distribution."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    points = np.zeros((3, u.shape[1]), u.dtype)
    for i in range(u.shape[1]):
        r = float(radius) * float(u[0, i]) ** (1 / 3)
        offset = _direction(float(u[1, i]), float(u[2, i]))
        points[:, i] = [float(c) + r * o for c, o in zip(center, offset, strict=True)]
    return points


def point_on_facing_disk(center, radius, point, u):
    """Basis from the cross product with the axis that is furthest from the line."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    points = np.zeros((3, u.shape[1]), np.result_type(point, u))
    c = [float(x) for x in center]
    for i in range(u.shape[1]):
        w = [c[axis] - float(point[axis, i]) for axis in range(3)]
        length = math.hypot(*w)
        w = [x / length for x in w] if length > 0 else [0.0, 0.0, 1.0]
        least = min(range(3), key=lambda axis, w=w: abs(w[axis]))
        helper = [float(axis == least) for axis in range(3)]
        s = _cross(w, helper)
        size = math.hypot(*s)
        s = [x / size for x in s]
        t = _cross(w, s)
        r = float(radius) * math.sqrt(float(u[1, i]))
        phi = 2 * math.pi * float(u[0, i])
        points[:, i] = [
            c[axis] + r * (math.sin(phi) * s[axis] + math.cos(phi) * t[axis]) for axis in range(3)
        ]
    return points


def _direction(a, b):
    theta, phi = math.acos(2 * a - 1), 2 * math.pi * b
    ring = math.sin(theta)
    return ring * math.sin(phi), math.cos(theta), ring * math.cos(phi)


def _cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
