"""Pixel by pixel and step by step, with lists and Python's numbers."""

import cmath
import itertools
import math
import random

import numpy as np


def z_order(x, y):
    """A string of binary digits for each pixel."""
    _pixels(x, y, 1 << 16)
    found = [_woven(i, j, 16) for i, j in zip(x.tolist(), y.tolist(), strict=True)]
    return np.array(found, np.int64)


def shuffled_z_order(x, y, levels, seed):
    """From the largest quadrants down; a generator of its own shuffles the parts of each."""
    if levels not in range(16) or seed not in range(1 << 32):
        raise ValueError("levels must be from 0 to 15, and seed in [0, 2^32)")
    _pixels(x, y, 1 << int(levels))
    orders = {}
    found = []
    for i, j in zip(x.tolist(), y.tolist(), strict=True):
        path, number = "", 0
        for level in reversed(range(levels)):
            if path not in orders:
                parts = [0, 1, 2, 3]
                random.Random(f"{seed}:{path}").shuffle(parts)
                orders[path] = parts
            part = (i >> level) % 2 + (j >> level) % 2 * 2
            number = 4 * number + orders[path][part]
            path += str(part)
        found.append(number)
    return np.array(found, np.int64)


def void_and_cluster(u, sigma):
    """Sums over all points, worked out anew for each step."""
    if np.ndim(u) != 2 or 0 in np.shape(u) or not sigma > 0 or sigma == math.inf:
        raise ValueError("u must have shape (H, W), and sigma be > 0")
    height, width = u.shape
    places = list(itertools.product(range(height), range(width)))
    weight = {
        (i, j): math.exp(-(min(i, height - i) ** 2 + min(j, width - j) ** 2) / (2 * sigma * sigma))
        for i, j in places
    }

    def crowd(place, points):
        i, j = place
        return math.fsum(weight[(i - a) % height, (j - b) % width] for a, b in points)

    def cluster(points):
        return max(sorted(points), key=lambda p: crowd(p, points))

    def void(points):
        return min((p for p in places if p not in points), key=lambda p: crowd(p, points))

    count = max(1, len(places) // 10)
    points = set(sorted(places, key=lambda p: u[p])[:count])
    while True:
        taken = cluster(points)
        points.remove(taken)
        free = void(points)
        if crowd(free, points) > crowd(taken, points) - 1e-9:
            points.add(taken)
            break
        points.add(free)
    ranks, left = np.zeros(u.shape, int), set(points)
    while left:
        taken = cluster(left)
        left.remove(taken)
        ranks[taken] = len(left)
    while len(points) < len(places):
        free = void(points)
        ranks[free] = len(points)
        points.add(free)
    return ranks


def dithered_points(points, masks, x, y):
    """Number by number."""
    if np.ndim(points) != 2 or np.ndim(masks) != 3 or len(points) != 2 or len(masks) != 2:
        raise ValueError("points must have shape (2, s), and masks (2, H, W)")
    if 0 in np.shape(masks)[1:]:
        raise ValueError("masks must not be empty")
    _pixels(x, y, math.inf)
    d, height, width = masks.shape
    found = np.empty((d, len(x), points.shape[1]), points.dtype)
    for k in range(d):
        for i, (column, row) in enumerate(zip(x.tolist(), y.tolist(), strict=True)):
            rank = int(masks[k, row % height, column % width])
            shift = (2 * rank + 1) / (2 * height * width)
            found[k, i] = [math.fmod(p + shift, 1) for p in points[k].tolist()]
    return found


def radial_spectrum(error, bins):
    """Each frequency's wave is summed by itself, first along the rows."""
    if np.ndim(error) != 2 or not np.size(error):
        raise ValueError("error must have shape (H, W)")
    if bins not in range(1, min(error.shape) // 2 + 1):
        raise ValueError("bins must be from 1 to half of the shorter side")
    height, width = error.shape
    turns = [[cmath.exp(-2j * cmath.pi * k / n) for k in range(n)] for n in (height, width)]
    rows = [
        [sum(e * turns[1][f * i % width] for i, e in enumerate(row)) for f in range(width)]
        for row in error.tolist()
    ]
    sums, counts = [0.0] * bins, [0] * bins
    for down, along in itertools.product(range(height), range(width)):
        value = sum(rows[j][along] * turns[0][down * j % height] for j in range(height))
        distance = math.hypot(min(down, height - down) / height, min(along, width - along) / width)
        if 0 < distance <= 0.5:
            place = math.ceil(distance * 2 * bins) - 1
            sums[place] += abs(value) ** 2 / (height * width)
            counts[place] += 1
    return np.array([s / n for s, n in zip(sums, counts, strict=True)]).astype(error.dtype)


def perceptual_rmse(error, sigma):
    """Each pixel's neighbours are weighed by themselves."""
    if np.ndim(error) != 2 or not np.size(error) or not sigma > 0 or sigma == math.inf:
        raise ValueError("error must have shape (H, W), and sigma be > 0")
    height, width = error.shape
    places = list(itertools.product(range(height), range(width)))
    values = error.tolist()
    squares = []
    for i, j in places:
        total = weights = 0.0
        for a, b in places:
            down, along = abs(i - a), abs(j - b)
            down, along = min(down, height - down), min(along, width - along)
            weight = math.exp(-(down * down + along * along) / (2 * sigma * sigma))
            total += weight * values[a][b]
            weights += weight
        squares.append((total / weights) ** 2)
    return error.dtype.type(math.sqrt(math.fsum(squares) / len(squares)))


def _woven(i, j, digits):
    """Binary digits of both, in turn, as a number."""
    pairs = zip(f"{j:0{digits}b}", f"{i:0{digits}b}", strict=True)
    return int("".join(map("".join, pairs)), 2)


def _pixels(x, y, end):
    if np.ndim(x) != 1 or np.shape(x) != np.shape(y):
        raise ValueError("x and y must have shape (N,)")
    for name, k in (("x", x), ("y", y)):
        if np.asarray(k).dtype.kind not in "iu" or any(not 0 <= n < end for n in k.tolist()):
            raise ValueError(f"{name} must be integers in [0, {end})")
