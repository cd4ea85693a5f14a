"""In double precision, by other formulae: a system of equations, arcus cosines, tents over all texels."""

import numpy as np


def rectangle_uv(p, p1, p2, p3):
    """Least squares."""
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    p1, p2, p3 = (np.asarray(point, float) for point in (p1, p2, p3))
    if (p2 == p1).all() or (p3 == p1).all():
        raise ValueError("p2 and p3 must be other points than p1")
    edges = np.stack((p2 - p1, p3 - p1), axis=1)
    return np.linalg.lstsq(edges, p - p1[:, None], rcond=None)[0].astype(p.dtype)


def sphere_uv(p, center):
    """An arcus cosine for the latitude, which keeps eight digits at the poles."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p.astype(float) - np.asarray(center, float)[:, None]
    r = np.sqrt(x * x + y * y + z * z)
    u = np.mod(-np.arctan2(z, x) / (2 * np.pi), 1)
    v = np.arccos(np.clip(-y / np.where(r == 0, 1, r), -1, 1)) / np.pi
    return np.stack((u, v)).astype(p.dtype)


def triangle_uv(barycentric, uv0, uv1, uv2):
    """An einsum over corners."""
    _check_batch("barycentric", barycentric, 3)
    n = np.shape(barycentric)[1]
    dtypes = [barycentric.dtype]
    corners = []
    for name, uv in (("uv0", uv0), ("uv1", uv1), ("uv2", uv2)):
        _check_uv(name, uv, n)
        if np.ndim(uv) == 2:
            dtypes.append(uv.dtype)
            corners.append(uv.astype(float))
        else:
            corners.append(np.repeat(np.asarray(uv, float)[:, None], n, axis=1))
    result = np.einsum("kn,kcn->cn", barycentric.astype(float), np.array(corners))
    return result.astype(np.result_type(*dtypes))


def texture_lookup(image, uv):
    """The picture padded by itself all around."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    height, width, _ = image.shape
    padded = np.pad(image.astype(float), ((1, 1), (1, 1), (0, 0)), mode="wrap")
    u, v = np.mod(uv.astype(float), 1)
    x, y = u * width + 0.5, (1 - v) * height + 0.5
    i, j = np.minimum(x.astype(int), width), np.minimum(y.astype(int), height)
    a, b = (x - i)[:, None], (y - j)[:, None]
    top = padded[j, i] * (1 - a) + padded[j, i + 1] * a
    bottom = padded[j + 1, i] * (1 - a) + padded[j + 1, i + 1] * a
    return (top * (1 - b) + bottom * b).T.astype(uv.dtype)
