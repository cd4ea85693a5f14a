"""Solid angles first, and strategies one at a time."""

import numpy as np


def area_density(area, distance, cos):
    """One over the solid angle that the lamp would fill if all of it were there."""
    if not area > 0:
        raise ValueError("area must be > 0")
    if np.ndim(distance) != 1 or np.shape(cos) != np.shape(distance):
        raise ValueError("distance and cos must have shape (N,)")
    kind = np.result_type(distance, cos)
    density = np.zeros(len(cos), kind)
    front = np.flatnonzero(cos > 0)
    inverse = float(area) * cos[front].astype(float) / distance[front].astype(float) ** 2
    density[front] = np.reciprocal(inverse)
    return density


def cone_density(radius, distance):
    """The cap's height over the unit sphere."""
    if not radius > 0:
        raise ValueError("radius must be > 0")
    if np.ndim(distance) != 1:
        raise ValueError("distance must have shape (N,)")
    angle = np.arcsin(np.minimum(radius / np.maximum(distance.astype(float), radius), 1))
    cap = 2 * np.sin(angle / 2) ** 2
    seen = (distance > radius) / (2 * np.pi)
    return np.divide(seen, cap).astype(distance.dtype)


def heuristic_weights(counts, densities, exponent):
    """Each strategy against all others, by their ratios."""
    if np.ndim(counts) != 1 or np.ndim(densities) != 2 or len(densities) != len(counts):
        raise ValueError("counts and densities must have shapes (S,) and (S, N)")
    if not all(k >= 0 for k in counts) or not np.all(densities >= 0) or not exponent >= 1:
        raise ValueError("counts and densities must be >= 0, exponent >= 1")
    expected = densities.astype(float).T * counts
    top = expected.max(axis=1, keepdims=True, initial=0)
    ratio = np.divide(expected, top, out=np.zeros_like(expected), where=top > 0)
    ratio = np.power(ratio, exponent)
    sums = ratio.sum(axis=1, keepdims=True)
    sums[sums == 0] = 1
    return np.ascontiguousarray((ratio / sums).T, densities.dtype)


def one_sample(odds, f, densities):
    """The mixture's density, strategy by strategy."""
    if np.ndim(odds) != 1 or np.ndim(densities) != 2 or len(densities) != len(odds):
        raise ValueError("odds and densities must have shapes (S,) and (S, N)")
    if np.ndim(f) != 2 or len(f) != 3 or f.shape[1] != densities.shape[1]:
        raise ValueError("f must have shape (3, N)")
    if not all(c >= 0 for c in odds) or not np.all(densities >= 0):
        raise ValueError("odds and densities must be >= 0")
    mixture = sum((c * p.astype(float) for c, p in zip(odds, densities, strict=True)), 0.0)
    estimates = np.zeros(f.shape)
    np.divide(f, mixture, out=estimates, where=mixture > 0)
    return estimates.astype(np.result_type(f, densities))
