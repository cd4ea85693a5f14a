"""In double precision, with masks; critical values by an expansion, and the angle where degrees are few."""

from statistics import NormalDist

import numpy as np


def _doubles(columns, *arrays):
    """The arrays in float64, and the dtype of the result; `columns` says which have one row."""
    n = np.shape(arrays[0])[-1:]
    for array, flat in zip(arrays, columns, strict=True):
        wanted = n if flat else (3, *n)
        if np.shape(array) != wanted or len(wanted) != (1 if flat else 2):
            raise ValueError(f"expected an array of shape {wanted}, got {np.shape(array)}")
    return [a.astype(np.float64) for a in arrays], np.result_type(*arrays)


def welch_t(mean_a, variance_a, count_a, mean_b, variance_b, count_b):
    """With NumPy's own infinities."""
    arrays = mean_a, variance_a, count_a, mean_b, variance_b, count_b
    (m, s, n, o, r, k), dtype = _doubles((0, 0, 1, 0, 0, 1), *arrays)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (m - o) / np.sqrt(s / n + r / k)
    t[m == o] = 0
    return t.astype(dtype)


def degrees_of_freedom(variance_a, count_a, variance_b, count_b):
    """With the numerator multiplied out."""
    (s, n, r, k), dtype = _doubles((0, 1, 0, 1), variance_a, count_a, variance_b, count_b)
    v, w = s / n, r / k
    found = np.broadcast_to(n + k - 2, v.shape).copy()
    some = (v > 0) | (w > 0)
    top = v * v + 2 * v * w + w * w
    bottom = v * v / (n - 1) + w * w / (k - 1)
    found[some] = top[some] / bottom[some]
    return found.astype(dtype)


def critical_value(degrees, level):
    """By Fisher's expansion for many degrees, and by Newton's method in the angle for few."""
    if np.ndim(degrees) != 1:
        raise ValueError(f"degrees must have shape (N,), got {np.shape(degrees)}")
    if not 0 < level < 1:
        raise ValueError(f"level must be within 0 and 1, got {level}")
    nu = degrees.astype(np.float64)
    z = NormalDist().inv_cdf(1 - level / 2)
    g1 = (z**3 + z) / 4
    g2 = (5 * z**5 + 16 * z**3 + 3 * z) / 96
    g3 = (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384
    found = z + g1 / nu + g2 / nu**2 + g3 / nu**3
    few = nu < 30
    if few.any():
        nodes = np.linspace(1 / 31, 1, 200)
        values = np.array([_by_angle(1 / node, level) for node in nodes])
        found[few] = np.exp(np.interp(1 / nu[few], nodes, np.log(values)))
    return found.astype(degrees.dtype)


def _by_angle(nu, level):
    """t = sqrt(nu) tan(angle), where the angle's density is cos^(nu - 1): what is left up to a right angle."""
    rest = (np.linspace(0, 1, 4001) ** 2) * np.pi / 2
    density = np.sin(rest) ** (nu - 1) if nu > 1 else np.ones_like(rest)
    steps = np.diff(rest) * (density[1:] + density[:-1]) / 2
    tail = np.concatenate(([0.0], np.cumsum(steps)))
    return np.sqrt(nu) / np.tan(np.interp(level, tail / tail[-1], rest))


def pair_weights(t, critical, distance, sigma):
    """By ratios."""
    (t, critical, distance), dtype = _doubles((0, 0, 1), t, critical, distance)
    if not (0 < sigma and np.isfinite(sigma)):
        raise ValueError(f"sigma must be over 0, got {sigma}")
    weights = np.exp(-(distance**2) / (2 * sigma**2))
    weights[(np.square(t) > np.square(critical)).any(axis=0)] = 0
    return weights.astype(dtype)


def weighted_mean(means, variances, weights):
    """By sums over the last axis."""
    shape = np.shape(means)
    if len(shape) != 3 or shape[0] != 3 or np.shape(variances) != shape:
        raise ValueError(f"means and variances must have shape (3, N, k), got {shape}")
    if np.shape(weights) != shape[1:]:
        raise ValueError(f"weights must have shape {shape[1:]}, got {np.shape(weights)}")
    w = weights.astype(np.float64)
    total, dtype = w.sum(axis=-1), np.result_type(means, variances, weights)
    mean = (w * means).sum(axis=-1) / total
    return mean.astype(dtype), ((w * w * variances).sum(axis=-1) / total**2).astype(dtype)


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """Multiplied out."""
    (f, v, m, s, p), dtype = _doubles(
        (0, 0, 0, 0, 1), filtered, filtered_variance, mean, variance, share
    )
    return ((m - f) * (m - f) - v - s + 2 * p * s).astype(dtype)
