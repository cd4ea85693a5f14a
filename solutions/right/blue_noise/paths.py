"""Quadrants level by level from above, a convolution by Fourier for each step, and a spectrum by autocorrelation."""

import itertools

import numpy as np


def z_order(x, y):
    """Digits of base 4, added up."""
    _both(x, y, 1 << 16)
    columns, rows = x.astype(np.uint64), y.astype(np.uint64)
    found = np.zeros(len(x), np.uint64)
    for k in range(16):
        scale = np.uint64(4**k)
        found += scale * (columns % np.uint64(2) + np.uint64(2) * (rows % np.uint64(2)))
        columns, rows = columns // np.uint64(2), rows // np.uint64(2)
    return found.astype(np.int64)


def shuffled_z_order(x, y, levels, seed):
    """One generator for each quadrant that has a pixel."""
    if not 0 <= levels <= 15 or levels % 1 or not 0 <= seed < 1 << 32:
        raise ValueError("levels must be from 0 to 15, and seed in [0, 2^32)")
    _both(x, y, 1 << int(levels))
    along = z_order(x, y)
    number = np.zeros(len(x), np.int64)
    for level in range(levels):
        quadrants, which = np.unique(along // 4 ** (level + 1), return_inverse=True)
        images = np.array([_shuffle(seed, level, int(q)) for q in quadrants], int).reshape(-1, 4)
        number += 4**level * images[which, along // 4**level % 4]
    return number


def void_and_cluster(u, sigma):
    """Crowds by the Fourier transform of each pattern."""
    if np.ndim(u) != 2 or not u.size or not (sigma > 0 and np.isfinite(sigma)):
        raise ValueError("u must have shape (H, W), and sigma be > 0")
    transfer = np.fft.rfft2(_weights(u.shape, sigma))

    def crowd(pattern):
        return np.fft.irfft2(np.fft.rfft2(pattern) * transfer, u.shape)

    def best(sums, allowed, sign):
        places = np.flatnonzero(allowed)
        return places[np.argmax(sign * sums.flat[places])]

    first = np.zeros(u.shape)
    first.flat[np.argpartition(u.ravel(), max(1, u.size // 10) - 1)[: max(1, u.size // 10)]] = 1
    while True:
        source = best(crowd(first), first == 1, 1)
        first.flat[source] = 0
        sums = crowd(first)
        target = best(sums, first == 0, -1)
        if sums.flat[target] >= sums.flat[source] - 1e-8:
            first.flat[source] = 1
            break
        first.flat[target] = 1
    down, pattern = [], first.copy()
    while pattern.any():
        down.append(best(crowd(pattern), pattern == 1, 1))
        pattern.flat[down[-1]] = 0
    up, pattern = [], first.copy()
    while not pattern.all():
        up.append(best(crowd(pattern), pattern == 0, -1))
        pattern.flat[up[-1]] = 1
    ranks = np.empty(u.size, np.int32)
    ranks[down[::-1] + up] = np.arange(u.size)
    return ranks.reshape(u.shape)


def dithered_points(points, masks, x, y):
    """A fraction is what is left without its whole part."""
    if np.ndim(points) != 2 or np.shape(points)[0] != 2:
        raise ValueError("points must have shape (2, s)")
    if np.ndim(masks) != 3 or np.shape(masks)[0] != 2 or masks.size == 0:
        raise ValueError("masks must have shape (2, H, W)")
    _both(x, y, 1 << 62)
    share = (masks.astype(np.float64) + 0.5) / masks[0].size
    rows, columns = np.mod(y, masks.shape[1]), np.mod(x, masks.shape[2])
    sums = share[:, rows, columns][:, :, np.newaxis] + points[:, np.newaxis, :]
    return (sums - np.floor(sums)).astype(points.dtype)


def radial_spectrum(error, bins):
    """The power is the transform of the error's correlation with itself."""
    if np.ndim(error) != 2 or not np.size(error):
        raise ValueError("error must have shape (H, W)")
    if bins not in range(1, min(error.shape) // 2 + 1):
        raise ValueError("bins must be from 1 to half of the shorter side")
    values = error.astype(np.float64)
    transform = np.fft.fft2(values)
    power = (transform * transform.conj()).real / values.size
    v, w = np.meshgrid(*(np.fft.fftfreq(n) for n in values.shape), indexing="ij")
    distance = np.sqrt(v**2 + w**2)
    edges = np.arange(bins + 1) / (2 * bins)
    found = []
    for low, high in itertools.pairwise(edges):
        ring = (distance > low + 1e-9) & (distance < high + 1e-9)
        found.append(power[ring].mean())
    return np.array(found, error.dtype)


def perceptual_rmse(error, sigma):
    """By Parseval, without going back."""
    if np.ndim(error) != 2 or not np.size(error) or not (sigma > 0 and np.isfinite(sigma)):
        raise ValueError("error must have shape (H, W), and sigma be > 0")
    weights = _weights(error.shape, sigma)
    transfer = np.fft.fft2(weights / weights.sum())
    seen = np.fft.fft2(error.astype(np.float64), norm="forward") * transfer
    return np.sqrt((np.abs(seen) ** 2).sum()).astype(error.dtype)


def _weights(shape, sigma):
    """Of the torus, seen from its first place."""
    grid = np.indices(shape)
    size = np.array(shape)[:, None, None]
    return np.exp(-(np.minimum(grid, size - grid) ** 2).sum(axis=0) / (2 * sigma**2))


def _shuffle(seed, level, quadrant):
    return np.random.default_rng((seed, level, quadrant)).permutation(4)


def _both(x, y, end):
    if np.ndim(x) != 1 or np.shape(x) != np.shape(y):
        raise ValueError(f"x and y must have shape (N,), got {np.shape(x)} and {np.shape(y)}")
    for k in (np.asarray(x), np.asarray(y)):
        if k.dtype.kind not in "iu" or (k < 0).any() or (k >= end).any():
            raise ValueError(f"x and y must be integers in [0, {end})")
