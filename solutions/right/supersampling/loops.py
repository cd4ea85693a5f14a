"""Plain Python loops over pixels, cells and samples."""

import math

import numpy as np


def regular(k, n):
    """One cell after the other."""
    _check_counts(k, n)
    points = np.zeros((2, n, k * k), np.float32)
    for row in range(k):
        for column in range(k):
            points[0, :, row * k + column] = (2 * column + 1) / (2 * k)
            points[1, :, row * k + column] = (2 * row + 1) / (2 * k)
    return points


def random(k, n, rng):
    """One pixel after the other."""
    _check_counts(k, n)
    points = np.zeros((2, n, k * k), np.float32)
    for pixel in range(n):
        points[:, pixel] = rng.uniform(size=(k * k, 2)).T
    return points


def jittered(k, n, rng):
    """One cell after the other, from its lower to its upper border."""
    _check_counts(k, n)
    points = np.zeros((2, n, k * k), np.float32)
    for cell in range(k * k):
        row, column = divmod(cell, k)
        points[0, :, cell] = rng.uniform(column / k, (column + 1) / k, n)
        points[1, :, cell] = rng.uniform(row / k, (row + 1) / k, n)
    return points


def gaussian_weights(offsets, sigma=1 / 6):
    """One sample after the other."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    _, n, s = offsets.shape
    weights = np.zeros((n, s), offsets.dtype)
    for pixel in range(n):
        for sample in range(s):
            dx = (float(offsets[0, pixel, sample]) - 0.5) / float(sigma)
            dy = (float(offsets[1, pixel, sample]) - 0.5) / float(sigma)
            r = math.hypot(dx, dy)
            weights[pixel, sample] = math.exp(-r * r / 2)
    return weights


def resolve(radiance, weights):
    """One pixel after the other."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    _, n, s = radiance.shape
    mean = np.zeros((3, n), np.result_type(radiance, weights))
    for pixel in range(n):
        w = [float(weight) for weight in weights[pixel]]
        total = math.fsum(w)
        if total == 0:
            w, total = [1.0] * s, s
        for channel in range(3):
            for sample in range(s):
                mean[channel, pixel] += float(radiance[channel, pixel, sample]) * (
                    w[sample] / total
                )
    return mean
