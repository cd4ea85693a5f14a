"""Bits spread by doubling gaps, orders by sorting, the mask by whole convolutions and blurs by rolled pictures."""

import numpy as np


def z_order(x, y):
    """Gaps of 8, 4, 2 and 1 bits."""
    _checked(x, y, 65536)
    return _spread(x) + 2 * _spread(y)


def shuffled_z_order(x, y, levels, seed):
    """Four random keys for each quadrant; a digit's image is its place among them."""
    if not (0 <= levels < 16 and levels == int(levels) and 0 <= seed < 2**32):
        raise ValueError("levels must be from 0 to 15, and seed in [0, 2^32)")
    _checked(x, y, 2**levels)
    number, quadrant = np.zeros(len(x), np.int64), np.zeros(len(x), np.int64)
    for level in range(levels - 1, -1, -1):
        part = (x.astype(np.int64) >> level) % 2 + 2 * ((y.astype(np.int64) >> level) % 2)
        keys = np.stack([_noise(4 * quadrant + k, seed, level) for k in range(4)])
        own = np.take_along_axis(keys, part[None], axis=0)
        number = 4 * number + (keys < own).sum(axis=0)
        quadrant = 4 * quadrant + part
    return number


def void_and_cluster(u, sigma):
    """The sums of each pattern by two matrices, one for the rows and one for the columns."""
    if np.ndim(u) != 2 or u.size == 0 or not 0 < sigma < np.inf:
        raise ValueError("u must have shape (H, W), and sigma be > 0")
    down, along = _ring(u.shape[0], sigma), _ring(u.shape[1], sigma)

    def crowd(pattern):
        return down @ pattern @ along

    def tightest(pattern):
        return np.unravel_index(np.argmax(crowd(pattern) - 1e9 * (1 - pattern)), u.shape)

    def emptiest(pattern):
        return np.unravel_index(np.argmin(crowd(pattern) + 1e9 * pattern), u.shape)

    total = max(1, u.size // 10)
    pattern = np.zeros(u.shape)
    pattern[np.unravel_index(np.argsort(u.ravel())[:total], u.shape)] = 1
    settled = False
    while not settled:
        source = tightest(pattern)
        pattern[source] = 0
        sums = crowd(pattern)
        target = emptiest(pattern)
        settled = sums[target] > sums[source] - 1e-7
        pattern[source if settled else target] = 1
    ranks = np.full(u.shape, -1)
    taken = pattern.copy()
    for rank in range(total - 1, -1, -1):
        at = tightest(taken)
        taken[at], ranks[at] = 0, rank
    for rank in range(total, u.size):
        at = emptiest(pattern)
        pattern[at], ranks[at] = 1, rank
    return ranks


def dithered_points(points, masks, x, y):
    """The mask is tiled over as many pixels as are asked for."""
    shape = np.shape(masks)
    if np.ndim(points) != 2 or len(shape) != 3 or len(points) != 2 or shape[0] != 2 or 0 in shape:
        raise ValueError("points must have shape (2, s), and masks (2, H, W)")
    _checked(x, y, np.inf)
    parts = shape[1] * shape[2]
    shifts = ((masks + 0.5) / parts).reshape(shape[0], parts)
    places = (y.astype(np.int64) % shape[1]) * shape[2] + x.astype(np.int64) % shape[2]
    moved = np.add(shifts[:, places][..., None], points[:, None])
    moved = np.where(moved >= 1, moved - 1, moved)
    return moved.astype(points.dtype)


def radial_spectrum(error, bins):
    """Real transforms along rows, and rings cut by sorted borders."""
    if np.ndim(error) != 2 or np.size(error) == 0:
        raise ValueError("error must have shape (H, W)")
    if not (1 <= bins <= min(error.shape) // 2 and bins == int(bins)):
        raise ValueError("bins must be from 1 to half of the shorter side")
    rows, columns = error.shape
    half = np.fft.rfft2(error.astype(np.float64), norm="ortho")
    # Columns that the real transform leaves out are mirrored ones.
    times = np.where((np.arange(half.shape[1]) * 2) % columns, 2, 1)
    squared = np.fft.fftfreq(rows)[:, None] ** 2 + np.fft.rfftfreq(columns) ** 2
    borders = (np.arange(bins + 1) / (2 * bins)) ** 2
    ring = np.searchsorted(borders, squared - 1e-12, side="right") - 1
    power, found = times * (half.real**2 + half.imag**2), np.empty(bins)
    for k in range(bins):
        own = (ring == k) & (squared > 0)
        found[k] = power[own].sum() / np.broadcast_to(times, own.shape)[own].sum()
    return found.astype(error.dtype)


def perceptual_rmse(error, sigma):
    """A blur of rows and then of columns: the Gaussian is a product."""
    if np.ndim(error) != 2 or np.size(error) == 0 or not 0 < sigma < np.inf:
        raise ValueError("error must have shape (H, W), and sigma be > 0")
    down, along = (_ring(n, sigma) for n in error.shape)
    seen = (down / down[0].sum()) @ error.astype(np.float64) @ (along / along[0].sum())
    return (np.linalg.norm(seen) / np.sqrt(seen.size)).astype(error.dtype)


def _ring(n, sigma):
    """Weights (n, n) of places on a ring of n, seen from each other."""
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    return np.exp(-0.5 * (np.minimum(apart, n - apart) / sigma) ** 2)


def _spread(k):
    bits = np.asarray(k).astype(np.uint64)
    for gap, mask in ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555)):
        bits = (bits | bits << np.uint64(gap)) & np.uint64(mask)
    return bits.astype(np.int64)


def _noise(keys, seed, level):
    """Words that look random."""
    word = keys.astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    word += np.uint64((seed * 64 + level + 1) * 0xC2B2AE3D27D4EB4F % 2**64)
    for _ in range(3):
        word ^= word >> np.uint64(29)
        word *= np.uint64(0xBF58476D1CE4E5B9)
    return word >> np.uint64(8)


def _checked(x, y, end):
    for k in (x, y):
        if np.ndim(k) != 1 or len(k) != len(np.atleast_1d(x)) or k.dtype.kind not in "iu":
            raise ValueError("x and y must be (N,) integers")
        if k.size and (k.min() < 0 or k.max() >= end):
            raise ValueError(f"x and y must be in [0, {end})")
