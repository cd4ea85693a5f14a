"""Single precision as it comes, the picture turned upside down first."""

import numpy as np


def rectangle_uv(p, p1, p2, p3):
    """Unit edges, then lengths."""
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    corner = np.asarray(p1, p.dtype)
    rows = []
    for point in (p2, p3):
        edge = np.asarray(point, p.dtype) - corner
        length = np.linalg.norm(edge)
        if length == 0:
            raise ValueError("p2 and p3 must be other points than p1")
        rows.append(np.einsum("i,ij->j", edge / length, p - corner[:, None]) / length)
    return np.array(rows)


def sphere_uv(p, center):
    """Half a turn added instead of a whole one where needed."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    d = p - np.asarray(center, p.dtype).reshape(3, 1)
    pi = p.dtype.type(np.pi)
    half = p.dtype.type(0.5)
    u = np.arctan2(d[2], -d[0]) / (2 * pi) + half
    v = half + np.arctan2(d[1], np.sqrt(d[0] * d[0] + d[2] * d[2])) / pi
    return np.stack((u, v))


def triangle_uv(barycentric, uv0, uv1, uv2):
    """Along two edges from corner 0, weighted with all three."""
    _check_batch("barycentric", barycentric, 3)
    for name, uv in (("uv0", uv0), ("uv1", uv1), ("uv2", uv2)):
        _check_uv(name, uv, np.shape(barycentric)[1])
    batches = [uv for uv in (uv0, uv1, uv2) if np.ndim(uv) == 2]
    dtype = np.result_type(barycentric, *batches)
    w = barycentric.astype(dtype)
    total = np.zeros((2, w.shape[1]), dtype)
    for weight, uv in zip(w, (uv0, uv1, uv2), strict=True):
        total += weight * (uv if np.ndim(uv) == 2 else np.asarray(uv, dtype)[:, None])
    return total


def texture_lookup(image, uv):
    """Rows from below; the roll of the picture is the neighbour."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    picture = np.asarray(image[::-1], uv.dtype)
    height, width, _ = picture.shape
    right = np.roll(picture, -1, axis=1)
    above, both = np.roll(picture, -1, axis=0), np.roll(right, -1, axis=0)
    x, y = np.mod(uv[0], 1) * width - 0.5, np.mod(uv[1], 1) * height - 0.5
    i, j = np.floor(x), np.floor(y)
    a, b = x - i, y - j
    at = j.astype(int) % height, i.astype(int) % width
    low = picture[at].T * (1 - a) + right[at].T * a
    high = above[at].T * (1 - a) + both[at].T * a
    return low * (1 - b) + high * b
