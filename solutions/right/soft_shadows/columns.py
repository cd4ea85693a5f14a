"""One column after the other into rows, handed back as a transposed view; numbers of u backwards."""

import numpy as np


def light_grid(corner, edge_u, edge_v, k):
    """Rows in memory, columns for the caller."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    points = [
        corner + (2 * i + 1) / (2 * k) * edge_u + (2 * j + 1) / (2 * k) * edge_v
        for i in range(k)
        for j in range(k)
    ]
    return np.array(points, np.float32).T


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Along the edges from the far ends."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    points = np.empty((u.shape[1], 3), u.dtype)
    for row, (a, b) in zip(points, u.T, strict=True):
        row[:] = corner + edge_u + edge_v - float(a) * edge_u - float(b) * edge_v
    return points.T


def point_on_sphere(center, radius, u):
    """The height along y."""
    return _each(center, radius, u, lambda _: 1.0)


def point_in_ball(center, radius, u):
    """The last number for the distance."""
    return _each(center, radius, u, lambda number: (1 - number[2]) ** (1 / 3), 3)


def _each(center, radius, u, far, rows=2):
    _check_single(center=center)
    _check_batch("u", u, rows)
    _check_radius(radius)
    points = np.empty((u.shape[1], 3), u.dtype)
    for row, number in zip(points, u.T.astype(float), strict=True):
        height, phi = 2 * number[1] - 1, -2 * np.pi * number[0]
        ring = np.sqrt(1 - height * height)
        normal = np.array([ring * np.sin(phi), height, ring * np.cos(phi)])
        row[:] = center + radius * far(number) * normal
    return points.T


def point_on_facing_disk(center, radius, point, u):
    """The plane from a singular value decomposition."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    points = np.empty((u.shape[1], 3), np.result_type(point, u))
    for row, place, (a, b) in zip(points, point.T, u.T.astype(float), strict=True):
        plane = np.linalg.svd((place - center)[None])[2][1:]
        phi = 2 * np.pi * a
        row[:] = center + radius * np.sqrt(b) * np.array([np.cos(phi), np.sin(phi)]) @ plane
    return points.T
