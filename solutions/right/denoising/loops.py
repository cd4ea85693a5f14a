"""Pixel by pixel; critical values by bisection in a tail that is a continued fraction."""

import math

import numpy as np


def welch_t(mean_a, variance_a, count_a, mean_b, variance_b, count_b):
    """Number by number."""
    _shapes(mean_a, (variance_a, mean_b, variance_b), (count_a, count_b))
    found = np.empty(
        mean_a.shape,
        np.result_type(mean_a, variance_a, count_a, mean_b, variance_b, count_b),
    )
    for i in range(found.shape[1]):
        for c in range(3):
            apart = float(mean_a[c, i]) - float(mean_b[c, i])
            squared = variance_a[c, i] / float(count_a[i]) + variance_b[c, i] / float(count_b[i])
            if squared > 0:
                found[c, i] = apart / math.sqrt(squared)
            else:
                found[c, i] = math.copysign(math.inf, apart) if apart else 0
    return found


def degrees_of_freedom(variance_a, count_a, variance_b, count_b):
    """Number by number."""
    _shapes(variance_a, (variance_b,), (count_a, count_b))
    found = np.empty(variance_a.shape, np.result_type(variance_a, count_a, variance_b, count_b))
    for i in range(found.shape[1]):
        n, m = float(count_a[i]), float(count_b[i])
        for c in range(3):
            v, w = float(variance_a[c, i]) / n, float(variance_b[c, i]) / m
            if v + w == 0:
                found[c, i] = n + m - 2
                continue
            share = v / (v + w)
            found[c, i] = 1 / (share**2 / (n - 1) + (1 - share) ** 2 / (m - 1))
    return found


def critical_value(degrees, level):
    """All at once, for a bisection takes sixty steps."""
    if np.ndim(degrees) != 1:
        raise ValueError(f"degrees must have shape (N,), got {np.shape(degrees)}")
    if not 0 < level < 1:
        raise ValueError("level must be over 0 and below 1")
    # Between the rows of a table of degrees, which are dense where they are few.
    nodes = [1 / (k / 300) for k in range(300, 0, -1)] + [1e5, 1e9]
    values = [_bisected(node, level) for node in nodes]
    x = [1 / node for node in nodes]
    return np.interp(1 / degrees, x[::-1], values[::-1]).astype(degrees.dtype)


def _bisected(degrees, level):
    low, high = 0.0, 1e7
    for _ in range(60):
        middle = math.sqrt(low * high) if low > 1 else (low + min(high, 2 * low + 1)) / 2
        if _tails(middle, degrees) > level:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _tails(t, degrees):
    """Probability beyond t on both sides: the regularised incomplete beta function of nu / 2 and 1 / 2."""
    if degrees > 1e8:
        return math.erfc(t / math.sqrt(2))
    x, a, b = degrees / (degrees + t * t), degrees / 2, 0.5
    if x > 0.999999999999:
        return 1.0
    front = math.exp(
        math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log(1 - x)
    )
    if x < (a + 1) / (a + b + 2):
        return front * _fraction(a, b, x) / a
    return 1 - front * _fraction(b, a, 1 - x) / b


def _fraction(a, b, x):
    """By Lentz's method."""
    c, d = 1.0, 1 / (1 - (a + b) * x / (a + 1))
    found = d
    for m in range(1, 500):
        before = found
        for top in (
            m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)),
        ):
            d = 1 / (1 + top * d)
            c = 1 + top / c
            found *= c * d
        if abs(found - before) < 1e-12 * abs(found):
            break
    return found


def pair_weights(t, critical, distance, sigma):
    """Pair by pair."""
    _shapes(t, (critical,), (distance,))
    if not (sigma > 0 and math.isfinite(sigma)):
        raise ValueError("sigma must be over 0 and finite")
    found = np.zeros(t.shape[1], np.result_type(t, critical, distance))
    for i in range(len(found)):
        if not any(abs(t[c, i]) > critical[c, i] for c in range(3)):
            found[i] = math.exp(-(float(distance[i]) ** 2) / (2 * sigma * sigma))
    return found


def weighted_mean(means, variances, weights):
    """Pixel by pixel."""
    shape = np.shape(means)
    if len(shape) != 3 or shape[0] != 3:
        raise ValueError(f"means must have shape (3, N, k), got {shape}")
    if np.shape(variances) != shape or np.shape(weights) != shape[1:]:
        raise ValueError(f"variances and weights must have shapes {shape} and {shape[1:]}")
    dtype = np.result_type(means, variances, weights)
    mean, variance = np.empty(shape[:2], dtype), np.empty(shape[:2], dtype)
    for i in range(shape[1]):
        row = weights[i].astype(float)
        for c in range(3):
            mean[c, i] = (row @ means[c, i]) / row.sum()
            variance[c, i] = (row**2 @ variances[c, i]) / row.sum() ** 2
    return mean, variance


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """Number by number."""
    _shapes(filtered, (filtered_variance, mean, variance), (share,))
    found = np.empty(
        filtered.shape, np.result_type(filtered, filtered_variance, mean, variance, share)
    )
    for i in range(found.shape[1]):
        for c in range(3):
            move = float(filtered[c, i]) - float(mean[c, i])
            common = float(share[i]) * float(variance[c, i])
            found[c, i] = move * move - (filtered_variance[c, i] + variance[c, i] - 2 * common)
    return found


def _shapes(first, others, rows):
    shape = np.shape(first)
    if len(shape) != 2 or shape[0] != 3:
        raise ValueError(f"the first argument must have shape (3, N), got {shape}")
    for other in others:
        if np.shape(other) != shape:
            raise ValueError(f"expected the shape {shape}, got {np.shape(other)}")
    for row in rows:
        if np.shape(row) != shape[1:]:
            raise ValueError(f"expected the shape {shape[1:]}, got {np.shape(row)}")
