"""One texel, one number and one direction after the other."""

import math
from bisect import bisect_right

import numpy as np


def texel_weights(image):
    """Texel by texel."""
    if np.ndim(image) != 3 or np.shape(image)[2] != 3 or not np.size(image):
        raise ValueError("image must have shape (H, W, 3)")
    if not (image >= 0).all():
        raise ValueError("image must be >= 0")
    height, width, _ = image.shape
    weights = np.empty((height, width), image.dtype)
    for i in range(height):
        # sin(a) - sin(b) by the product: no digits are lost next to the poles.
        middle, half = math.pi * (i + 0.5) / height, math.pi / (2 * height)
        solid_angle = 2 * math.pi / width * 2 * math.sin(middle) * math.sin(half)
        for j in range(width):
            r, g, b = image[i, j].tolist()
            weights[i, j] = (r + g + b) / 3 * solid_angle
    return weights


def cumulate(weights):
    """Row by row."""
    if np.ndim(weights) != 2:
        raise ValueError("weights must have shape (H, W)")
    if not (weights >= 0).all() or not weights.any():
        raise ValueError("weights must be >= 0, and not 0 everywhere")
    height, width = weights.shape
    sums, columns, total = [], np.empty((height, width)), 0.0
    for i in range(height):
        row = weights[i].tolist()
        each = math.fsum(row)
        running = 0.0
        for j in range(width):
            running += row[j] if each else 1.0
            columns[i, j] = running
        columns[i] /= running
        total += each
        sums.append(total)
    return np.array(sums) / total, columns


def sample_direction(rows, columns, u):
    """Number by number."""
    if np.ndim(columns) != 2 or np.shape(rows) != np.shape(columns)[:1]:
        raise ValueError("rows and columns must have shapes (H,) and (H, W)")
    if np.ndim(u) != 2 or np.shape(u)[0] != 2:
        raise ValueError("u must have shape (2, N)")
    height, width = columns.shape
    edges, found = rows.tolist(), np.empty((3, u.shape[1]), u.dtype)
    for n in range(u.shape[1]):
        a, b = float(u[0, n]), float(u[1, n])
        i = bisect_right(edges, a)
        row = columns[i].tolist()
        j = bisect_right(row, b)
        low, left = edges[i - 1] if i else 0.0, row[j - 1] if j else 0.0
        y0, y1 = math.cos(math.pi * i / height), math.cos(math.pi * (i + 1) / height)
        y = y0 + (a - low) / (edges[i] - low) * (y1 - y0)
        phi = 2 * math.pi * (j + (b - left) / (row[j] - left)) / width
        ring = math.sqrt(max(0.0, 1 - y * y))
        # Half a turn before the middle of the picture.
        found[:, n] = -ring * math.sin(phi), y, ring * math.cos(phi)
    return found


def alias_table(weights):
    """Walker's own way: the poorest and the richest, again and again."""
    if np.ndim(weights) != 1:
        raise ValueError("weights must have shape (K,)")
    if not (weights >= 0).all() or not weights.any():
        raise ValueError("weights must be >= 0, and not 0 everywhere")
    left = weights.astype(np.float64) / weights.sum(dtype=np.float64) * len(weights)
    probability, alias = np.ones(len(left)), np.arange(len(left))
    todo = list(range(len(left)))
    while len(todo) > 1:
        todo.sort(key=lambda k: left[k])
        poor, rich = todo[0], todo[-1]
        probability[poor], alias[poor] = min(left[poor], 1.0), rich
        left[rich] -= 1 - probability[poor]
        todo.remove(poor)
    return probability, alias
