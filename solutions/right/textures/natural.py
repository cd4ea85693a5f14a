"""As one writes it first: points with an axis more, whatever dtype comes of it, and cast at the end."""

import numpy as np


def rectangle_uv(p, p1, p2, p3):
    """Two projections."""
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    if (p2 == p1).all() or (p3 == p1).all():
        raise ValueError("p2 and p3 must be other points than p1")
    q = p - p1[:, None]
    edge_u, edge_v = p2 - p1, p3 - p1
    u = (q * edge_u[:, None]).sum(axis=0) / np.dot(edge_u, edge_u)
    v = (q * edge_v[:, None]).sum(axis=0) / np.dot(edge_v, edge_v)
    return np.array([u, v]).astype(p.dtype)


def sphere_uv(p, center):
    """Angles, the result a view of points in rows."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = d = p - center[:, None]
    u = np.arctan2(-z, x) / (2 * np.pi) % 1
    v = 1 - np.arccos(np.clip(y / np.linalg.norm(d.astype(float), axis=0), -1, 1)) / np.pi
    return np.column_stack((u, v)).astype(p.dtype).T


def triangle_uv(barycentric, uv0, uv1, uv2):
    """Singles with an axis more; results in Fortran's order."""
    _check_batch("barycentric", barycentric, 3)
    for name, uv in (("uv0", uv0), ("uv1", uv1), ("uv2", uv2)):
        _check_uv(name, uv, np.shape(barycentric)[1])
    dtype = np.result_type(barycentric, *(uv for uv in (uv0, uv1, uv2) if uv.ndim == 2))
    total = 0
    for weight, uv in zip(barycentric, (uv0, uv1, uv2), strict=True):
        total = total + weight * (uv if uv.ndim == 2 else uv[:, None])
    return np.asfortranarray(total, dtype)


def texture_lookup(image, uv):
    """A copy of the places moved in place, texels by advanced indices."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    height, width, _ = image.shape
    places = uv.copy()
    places -= np.floor(places)
    x = places[0] * width - 0.5
    y = (1 - places[1]) * height - 0.5
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - x0)[:, None], (y - y0)[:, None]
    x1, y1 = (x0 + 1) % width, (y0 + 1) % height
    x0, y0 = x0 % width, y0 % height
    top = image[y0, x0] * (1 - fx) + image[y0, x1] * fx
    bottom = image[y1, x0] * (1 - fx) + image[y1, x1] * fx
    return (top * (1 - fy) + bottom * fy).T.astype(uv.dtype)
