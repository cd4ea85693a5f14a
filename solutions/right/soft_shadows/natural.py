"""The most natural form: a single point as a column, formulas as they stand in a textbook, the dtype put right at the end."""

import numpy as np


def light_grid(corner, edge_u, edge_v, k):
    """The centres along both edges, all pairs of them."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    t = (np.arange(k) + 0.5) / k
    a, b = np.meshgrid(t, t)
    points = corner[:, None] + edge_u[:, None] * a.ravel() + edge_v[:, None] * b.ravel()
    return points.astype(np.float32)


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Corner and steps along both edges."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    return (corner[:, None] + edge_u[:, None] * u[0] + edge_v[:, None] * u[1]).astype(u.dtype)


def point_on_sphere(center, radius, u):
    """Centre and radius times direction."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)
    return (center[:, None] + radius * _normals(u)).astype(u.dtype)


def point_in_ball(center, radius, u):
    """A direction, and the cube root of a number."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    return (center[:, None] + radius * u[2] ** (1 / 3) * _normals(u[:2])).astype(u.dtype)


def point_on_facing_disk(center, radius, point, u):
    """Two vectors orthogonal to the way to the centre, by cross products of transposes."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    w = (center[:, None] - point).T
    helper = np.where(np.abs(w[:, :1]) < np.abs(w[:, 1:2]), [1.0, 0, 0], [0, 1.0, 0])
    s = np.cross(w, helper)
    s[~s.any(axis=1)] = [1, 0, 0]
    s /= np.linalg.norm(s, axis=1, keepdims=True)
    t = np.cross(w, s)
    t[~t.any(axis=1)] = [0, 1, 0]
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    r, phi = radius * np.sqrt(u[0]), 2 * np.pi * u[1]
    points = center[:, None] + r * np.cos(phi) * s.T + r * np.sin(phi) * t.T
    return points.astype(np.result_type(point, u))


def _normals(u):
    z = 1 - 2 * u[0]
    ring = np.sqrt(1 - z**2)
    phi = 2 * np.pi * u[1]
    return np.array([ring * np.cos(phi), ring * np.sin(phi), z])
