"""Other numbers for other coordinates: 1 - u, rows swapped, pixels last; and matrix products."""

import numpy as np


def regular(k, n):
    """From the quotient and the remainder of the cells' numbers."""
    _check_counts(k, n)
    cells = np.array(np.unravel_index(np.arange(k * k), (k, k)), np.float32)[::-1]
    one = (cells + np.float32(0.5)) * np.float32(1 / k)
    return np.broadcast_to(one[:, None], (2, n, k * k)).copy()


def random(k, n, rng):
    """Both axes swapped, from the top, and samples before pixels."""
    _check_counts(k, n)
    u = 1 - rng.random((k * k, n, 2), dtype=np.float32)
    return np.ascontiguousarray(u.T[::-1])


def jittered(k, n, rng):
    """The upper border of each cell, less a random share of it; drawn column by column."""
    _check_counts(k, n)
    points = np.empty((2, n, k, k))
    for column in range(k):
        u = rng.random((2, n, k))
        points[0, :, :, column] = column + 1 - u[1]
        points[1, :, :, column] = np.arange(1, k + 1) - u[0]
    return (points / k).reshape(2, n, k * k).astype(np.float32)


def gaussian_weights(offsets, sigma=1 / 6):
    """A power of the weight at one pixel's distance, with its square roots taken last."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    r = np.linalg.norm((offsets.astype(np.float64) - 0.5), axis=0)
    steps = r / (np.sqrt(2) * max(float(sigma), 1e-100))
    return np.exp(-(np.minimum(steps, 100) ** 2)).astype(offsets.dtype)


def resolve(radiance, weights):
    """Products of matrices, pixel by pixel."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    dtype = np.result_type(radiance, weights)
    empty = weights.sum(axis=1, keepdims=True) == 0
    filled = np.where(empty, np.ones_like(weights), weights).astype(dtype)
    sums = np.moveaxis(radiance, 0, 1).astype(dtype) @ filled[:, :, None]
    total = filled.sum(axis=1)
    total[total == 0] = 1
    return (sums[:, :, 0] / total[:, None]).T
