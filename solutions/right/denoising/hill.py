"""Critical values by Hill's algorithm 396 between whole degrees; the rest by products."""

from statistics import NormalDist

import numpy as np


def welch_t(mean_a, variance_a, count_a, mean_b, variance_b, count_b):
    """The variance over both counts."""
    _check("mean_a", mean_a, 3, "N")
    for name, array in (("variance_a", variance_a), ("mean_b", mean_b), ("variance_b", variance_b)):
        _check(name, array, *np.shape(mean_a))
    for name, array in (("count_a", count_a), ("count_b", count_b)):
        _check(name, array, np.shape(mean_a)[1])
    dtype = np.result_type(mean_a, variance_a, count_a, mean_b, variance_b, count_b)
    top = mean_a - mean_b
    square = (variance_a * count_b + variance_b * count_a) / (count_a * count_b)
    sure = ~(square > 0)
    t = top * np.where(sure, 1, square) ** -0.5
    t[sure] = np.where(top[sure] > 0, np.inf, np.where(top[sure] < 0, -np.inf, 0))
    return t.astype(dtype)


def degrees_of_freedom(variance_a, count_a, variance_b, count_b):
    """By the share of one pixel."""
    _check("variance_a", variance_a, 3, "N")
    _check("variance_b", variance_b, *np.shape(variance_a))
    for name, array in (("count_a", count_a), ("count_b", count_b)):
        _check(name, array, np.shape(variance_a)[1])
    a, b = variance_a * count_b, variance_b * count_a
    sure = (a == 0) & (b == 0)
    c = a / np.where(sure, 1, a + b)
    bottom = c * c * (count_b - 1) + (1 - c) * (1 - c) * (count_a - 1)
    found = np.where(sure, count_a + count_b - 2, (count_a - 1) * (count_b - 1) / bottom)
    return found.astype(np.result_type(variance_a, count_a, variance_b, count_b))


def critical_value(degrees, level):
    """Exact for one and two degrees, and an expansion of the normal quantile beyond five."""
    _check("degrees", degrees, "N")
    if not (level > 0 and level < 1):
        raise ValueError(f"level must be over 0 and below 1, got {level}")
    few = np.array([1, 1.25, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 5, 6, 7])
    table = [_solved(nu, level) for nu in few]
    small = np.exp(_smooth(1 / few, np.log(table), 1 / np.minimum(degrees, 7)))
    return np.where(degrees < 7, small, _expanded(np.maximum(degrees, 5), level)).astype(
        degrees.dtype
    )


def _expanded(n, level):
    x = NormalDist().inv_cdf(level / 2)
    a = 1 / (n - 0.5)
    b = 48 / a**2
    c = ((20700 * a / b - 98) * a - 16) * a + 96.36
    d = ((94.5 / (b + c) - 3) / b + 1) * np.sqrt(a * np.pi / 2) * n
    y = x * x
    c = (((0.05 * d * x - 5) * x - 7) * x - 2) * x + b + c
    y = (((((0.4 * y + 6.3) * y + 36) * y + 94.5) / c - y - 3) / b + 1) * x
    return np.sqrt(n * np.expm1(a * y * y))


def _solved(nu, level):
    """Halving intervals of the angle, whose density is cos^(nu - 1)."""
    # A square puts more steps next to the right angle, where the tail ends.
    v = (np.arange(20000) + 0.5) / 20000
    rest = v * v * np.pi / 2
    density = np.sin(rest) ** (nu - 1) * v
    tail = np.cumsum(density) / density.sum()
    at = np.interp(level, tail, (v + 0.5 / 20000) ** 2 * np.pi / 2)
    return np.sqrt(nu) / np.tan(at)


def _smooth(x, y, at):
    """Lagrange's polynomial through the points."""
    found = np.zeros(len(at))
    for i, xi in enumerate(x):
        others = np.delete(x, i)
        found += y[i] * np.prod([(at - o) / (xi - o) for o in others], axis=0)
    return found


def pair_weights(t, critical, distance, sigma):
    """By the largest excess."""
    _check("t", t, 3, "N")
    _check("critical", critical, *np.shape(t))
    _check("distance", distance, np.shape(t)[1])
    if not (sigma > 0) or np.isinf(sigma):
        raise ValueError(f"sigma must be over 0 and finite, got {sigma}")
    over = np.maximum(t - critical, -t - critical).max(axis=0, initial=-np.inf)
    gaussian = np.exp(-np.square(distance / (np.sqrt(2) * sigma)))
    return np.where(over > 0, 0, gaussian).astype(np.result_type(t, critical, distance))


def weighted_mean(means, variances, weights):
    """As matrices."""
    _check("means", means, 3, "N", "k")
    _check("variances", variances, *np.shape(means))
    _check("weights", weights, *np.shape(means)[1:])
    dtype = np.result_type(means, variances, weights)
    total = weights.sum(axis=1)
    mean = np.matmul(means.transpose(1, 0, 2), weights[:, :, None])[..., 0].T / total
    square = np.matmul(variances.transpose(1, 0, 2), weights[:, :, None] ** 2)[..., 0].T
    return mean.astype(dtype), (square / total**2).astype(dtype)


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """Variances are subtracted one after the other."""
    _check("filtered", filtered, 3, "N")
    shape = np.shape(filtered)
    _check("filtered_variance", filtered_variance, *shape)
    _check("mean", mean, *shape)
    _check("variance", variance, *shape)
    _check("share", share, shape[1])
    found = np.square(filtered - mean) - filtered_variance
    found = found - variance + 2 * (share * variance)
    return found.astype(np.result_type(filtered, filtered_variance, mean, variance, share))
