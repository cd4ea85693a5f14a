"""Rows of u swapped and mirrored; the sphere from two disks, the disk from half angles, all in the batch's dtype."""

import numpy as np


def light_grid(corner, edge_u, edge_v, k):
    """From the far corner back."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    corner, edge_u, edge_v = (np.array(x, np.float32) for x in (corner, edge_u, edge_v))
    far = corner + edge_u + edge_v
    steps = np.linspace(1 / (2 * k), 1 - 1 / (2 * k), k, dtype=np.float32)
    grid = far - edge_u * steps[:, None, None] - edge_v * steps[None, :, None]
    return grid.reshape(k * k, 3).T


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Rows swapped, one of them mirrored."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    points = np.empty((3, u.shape[1]), u.dtype)
    for row, start, a, b in zip(points, corner, edge_u, edge_v, strict=True):
        row[:] = start + u[1] * u.dtype.type(a) + (1 - u[0]) * u.dtype.type(b)
    return points


def point_on_sphere(center, radius, u):
    """Two disks, each lifted to its half of the sphere with its area kept."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)
    one = u.dtype.type
    upper = u[1] < 0.5
    share = np.where(upper, 2 * u[1], 2 * u[1] - 1)
    z = np.where(upper, 1 - share, share - 1)
    ring = np.sqrt(share * (2 - share))
    phi = one(2 * np.pi) * (1 - u[0])
    direction = np.stack((z, ring * np.sin(phi), ring * np.cos(phi)))
    return np.array(center, u.dtype)[:, None] + one(radius) * direction


def point_in_ball(center, radius, u):
    """Distance from the middle row, by logarithm and exponential."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    one = u.dtype.type
    direction = point_on_sphere((0, 0, 0), 1, u[::2])
    share = np.maximum(u[1], np.finfo(u.dtype).tiny)
    r = one(radius) * np.exp(np.log(share) / 3)
    return np.array(center, u.dtype)[:, None] + np.minimum(r, one(radius)) * direction


def point_on_facing_disk(center, radius, point, u):
    """Basis turned in the plane of the two larger coordinates."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    dtype = np.result_type(point, u)
    c = np.array(center, dtype)[:, None]
    x, y, z = w = point.astype(dtype) - c
    zero = np.zeros_like(x)
    steep = np.abs(x) > np.abs(z)
    s = np.where(steep, np.stack((-y, x, zero)), np.stack((zero, -z, y)))
    s = _unit(s, (1, 0, 0))
    t = _unit(np.cross(_unit(w, (0, 0, 1)), s, axis=0), (0, 1, 0))
    r = dtype.type(radius) * np.sqrt(1 - u[1].astype(dtype))
    phi = dtype.type(2 * np.pi) * u[0].astype(dtype)
    return c + r * (np.cos(phi) * s + np.sin(phi) * t)


def _unit(v, otherwise):
    """Unit vectors; another where there is no length."""
    length = np.sqrt((v * v).sum(axis=0))
    fallback = np.array(otherwise, v.dtype)[:, None]
    return np.where(length > 0, v / np.where(length > 0, length, 1), fallback)
