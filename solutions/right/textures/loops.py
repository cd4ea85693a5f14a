"""Plain Python, one point at a time."""

import math

import numpy as np


def rectangle_uv(p, p1, p2, p3):
    """Dot products for each point."""
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    p1, p2, p3 = (np.asarray(point, float) for point in (p1, p2, p3))
    result = np.empty((2, p.shape[1]), p.dtype)
    for row, edge in enumerate((p2 - p1, p3 - p1)):
        if not edge.any():
            raise ValueError("p2 and p3 must be other points than p1")
        for k in range(p.shape[1]):
            result[row, k] = (p[:, k] - p1) @ edge / (edge @ edge)
    return result


def sphere_uv(p, center):
    """Angles for each point."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    result = np.empty((2, p.shape[1]), p.dtype)
    for k in range(p.shape[1]):
        x, y, z = (float(a) - float(b) for a, b in zip(p[:, k], center, strict=True))
        u = math.atan2(-z, x) / (2 * math.pi)
        result[:, k] = u if u >= 0 else u + 1, 0.5 + math.atan2(y, math.hypot(x, z)) / math.pi
    return result


def triangle_uv(barycentric, uv0, uv1, uv2):
    """A sum for each point."""
    _check_batch("barycentric", barycentric, 3)
    n = barycentric.shape[1]
    for name, uv in (("uv0", uv0), ("uv1", uv1), ("uv2", uv2)):
        _check_uv(name, uv, n)
    batches = [barycentric] + [uv for uv in (uv0, uv1, uv2) if np.ndim(uv) == 2]
    result = np.zeros((2, n), np.result_type(*batches))
    for k in range(n):
        total = np.zeros(2)
        for weight, uv in zip(barycentric[:, k], (uv0, uv1, uv2), strict=True):
            total += float(weight) * np.asarray(uv[:, k] if np.ndim(uv) == 2 else uv, float)
        result[:, k] = total
    return result


def texture_lookup(image, uv):
    """Four texels for each place."""
    _check_image(image)
    _check_batch("uv", uv, 2)
    height, width, _ = image.shape
    result = np.empty((3, uv.shape[1]), uv.dtype)
    for n, (u, v) in enumerate(uv.T.astype(float)):
        x, y = u * width - 0.5, -v * height - 0.5
        i, j = math.floor(x), math.floor(y)
        a, b = x - i, y - j
        color = np.zeros(3)
        for down, along_y in ((0, 1 - b), (1, b)):
            for right, along_x in ((0, 1 - a), (1, a)):
                color += along_x * along_y * image[(j + down) % height, (i + right) % width]
        result[:, n] = color
    return result
