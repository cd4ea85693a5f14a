"""Everything in float64, and cast at the very end; matrices instead of rows."""

import numpy as np


def light_grid(corner, edge_u, edge_v, k):
    """Corner plus a matrix of edges times a matrix of steps."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    steps = (np.indices((k, k)).reshape(2, -1) * 2 + 1) / (2 * k)
    edges = np.array([edge_u, edge_v], np.float64).T
    return (np.array(corner, np.float64)[:, None] + edges @ steps).astype(np.float32)


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Between two points on opposite edges."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    edges = np.array([edge_u, edge_v], np.float64).T
    return (np.array(corner, np.float64)[:, None] + edges @ (1 - u)).astype(u.dtype)


def point_on_sphere(center, radius, u):
    """Uniform height along x."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)
    offset = float(radius) * _directions(u.astype(np.float64))
    return (np.array(center, np.float64)[:, None] + offset).astype(u.dtype)


def point_in_ball(center, radius, u):
    """The first number is the share of the volume within."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    wide = u.astype(np.float64)
    offset = float(radius) * (1 - wide[0]) ** (1 / 3) * _directions(wide[1:])
    return (np.array(center, np.float64)[:, None] + offset).astype(u.dtype)


def point_on_facing_disk(center, radius, point, u):
    """A disk in x and y, mirrored so that z goes along the line to the point."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    c = np.array(center, np.float64)[:, None]
    w = point.astype(np.float64) - c
    length = np.linalg.norm(w, axis=0)
    w[:, length == 0] = [[0], [0], [1]]
    w /= np.where(length == 0, 1, length)
    a, b = 2 * u.astype(np.float64) - 1
    offset = float(radius) * np.stack((*_concentric(a, b), np.zeros_like(a)))
    # The mirror between z and w, or between z and -w where these two are too close for it.
    half = np.where(w[2] > 0, 1, -1) * w + [[0], [0], [1]]
    half /= np.linalg.norm(half, axis=0)
    offset -= 2 * half * (half * offset).sum(axis=0)
    return (c + offset).astype(np.result_type(point, u))


def _concentric(a, b):
    """Shirley and Chiu's map from the square to the disk."""
    first = np.abs(a) > np.abs(b)
    r = np.where(first, a, b)
    safe = np.where(r == 0, 1, r)
    phi = np.where(first, np.pi / 4 * b / safe, np.pi / 2 - np.pi / 4 * a / safe)
    return r * np.cos(phi), r * np.sin(phi)


def _directions(u):
    height = 2 * u[1] - 1
    ring = np.sqrt(np.maximum(1 - height**2, 0))
    angle = -2 * np.pi * u[0]
    return np.stack((height, ring * np.cos(angle), ring * np.sin(angle)))
