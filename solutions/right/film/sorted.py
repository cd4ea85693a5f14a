"""The percentile by sorting, primaries by Cramer's rule."""

import numpy as np


def photographic(radiance, key, burn, saturation):
    """Luminances sorted once, colours from logarithms of ratios."""
    _check_batch("radiance", radiance, 3)
    _check_number("key", key, 0 < key < np.inf, "finite and > 0")
    _check_number("burn", burn, 0 <= burn <= 100, "from 0 to 100")
    _check_number("saturation", saturation, 0 <= saturation < np.inf, "finite and >= 0")
    exact = radiance.astype(np.float64)
    y = 0.2126 * exact[0] + 0.7152 * exact[1] + 0.0722 * exact[2]
    order = np.sort(y)
    if order.size == 0 or order[-1] <= 0:
        return np.zeros_like(radiance)
    place = (100 - burn) / 100 * (order.size - 1)
    below = int(place)
    above = min(below + 1, order.size - 1)
    white = order[below] + (place - below) * (order[above] - order[below])
    if white == 0:
        return np.zeros_like(radiance)
    mean = 2 ** np.mean(np.log2(y[y > 0]))
    tone = y / mean * key
    display = (tone + (tone * mean / (white * key)) ** 2) / (1 + tone)
    safe = np.where(y > 0, y, 1)
    return np.where(y > 0, display * (exact / safe) ** saturation, 0).astype(radiance.dtype)


def convert_gamut(rgb, source, target):
    """Pixels to XYZ, and back by an inverse."""
    _check_batch("rgb", rgb, 3)
    if np.shape(source) != (2, 4) or np.shape(target) != (2, 4):
        raise ValueError("source and target must have shape (2, 4)")

    def matrix(gamut):
        x, y = np.asarray(gamut, float)
        xyz = np.array([x, y, 1 - x - y])
        whole = np.linalg.det(xyz[:, :3])
        amounts = []
        for k in range(3):
            other = xyz[:, :3].copy()
            other[:, k] = xyz[:, 3] / y[3]
            amounts.append(np.linalg.det(other) / whole)
        return xyz[:, :3] @ np.diag(amounts)

    light = matrix(source) @ rgb.astype(float)
    return (np.linalg.inv(matrix(target)) @ light).astype(rgb.dtype)
