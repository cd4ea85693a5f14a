"""One sample after the other, with Python's numbers."""

import math

import numpy as np


def area_density(area, distance, cos):
    """By the lamp's solid angle."""
    if not area > 0:
        raise ValueError("area must be > 0")
    if np.ndim(distance) != 1 or np.shape(cos) != np.shape(distance):
        raise ValueError("distance and cos must have shape (N,)")
    found = []
    for d, c in zip(distance.tolist(), cos.tolist(), strict=True):
        found.append(1 / (area * c / d / d) if c > 0 else 0.0)
    return np.array(found, np.result_type(distance, cos))


def cone_density(radius, distance):
    """By the half angle: 1 - cos a is 2 sin^2(a / 2)."""
    if not radius > 0:
        raise ValueError("radius must be > 0")
    if np.ndim(distance) != 1:
        raise ValueError("distance must have shape (N,)")
    found = np.zeros(len(distance), distance.dtype)
    for k, d in enumerate(distance.tolist()):
        if d > radius:
            found[k] = 1 / (4 * math.pi * math.sin(math.asin(radius / d) / 2) ** 2)
    return found


def heuristic_weights(counts, densities, exponent):
    """Each weight is 1 over the sum of the ratios to its own."""
    if np.ndim(counts) != 1 or np.ndim(densities) != 2 or len(densities) != len(counts):
        raise ValueError("counts and densities must have shapes (S,) and (S, N)")
    if min(counts.tolist(), default=0) < 0 or not (densities >= 0).all() or not exponent >= 1:
        raise ValueError("counts and densities must be >= 0, exponent >= 1")
    found = np.zeros_like(densities)
    for n in range(densities.shape[1]):
        reach = [int(k) * float(p) for k, p in zip(counts, densities[:, n], strict=True)]
        for s, mine in enumerate(reach):
            if mine == max(reach) > 0:
                found[s, n] = 1 / sum((other / mine) ** exponent for other in reach)
        best = reach.index(max(reach)) if reach else 0
        for s, mine in enumerate(reach):
            if 0 < mine < max(reach):
                found[s, n] = found[best, n] * (mine / reach[best]) ** exponent
    return found


def delta_weights(counts, densities, delta):
    """Two lists for each sample: its deltas, and the rest."""
    if np.ndim(counts) != 1 or np.ndim(densities) != 2 or len(densities) != len(counts):
        raise ValueError("counts and densities must have shapes (S,) and (S, N)")
    if np.shape(delta) != np.shape(densities):
        raise ValueError("delta must have the shape of densities")
    if min(counts.tolist(), default=0) < 0 or not (densities >= 0).all():
        raise ValueError("counts and densities must be >= 0")
    found = np.zeros_like(densities)
    for n in range(densities.shape[1]):
        reach = [float(k) * float(p) for k, p in zip(counts, densities[:, n], strict=True)]
        sharing = [s for s in range(len(reach)) if delta[s, n] and reach[s]] or range(len(reach))
        total = math.fsum(reach[s] for s in sharing)
        for s in sharing:
            found[s, n] = reach[s] / total if total else 0.0
    return found


def multi_sample(counts, strategy, f, densities, weights):
    """Strategy by strategy, each with its own mean."""
    if np.ndim(counts) != 1 or np.ndim(f) != 2 or len(f) != 3:
        raise ValueError("counts and f must have shapes (S,) and (3, N)")
    for each in (strategy, densities, weights):
        if np.shape(each) != (f.shape[1],):
            raise ValueError("strategy, densities and weights must have shape (N,)")
    total = [0.0, 0.0, 0.0]
    for s, count in enumerate(counts.tolist()):
        for n in np.flatnonzero((strategy == s) & (densities > 0)).tolist():
            scale = float(weights[n]) / float(densities[n]) / count
            for channel in range(3):
                total[channel] += scale * float(f[channel, n])
    return np.array(total, np.result_type(f, densities, weights))


def one_sample(odds, f, densities):
    """Estimate by estimate."""
    if np.ndim(odds) != 1 or np.ndim(densities) != 2 or len(densities) != len(odds):
        raise ValueError("odds and densities must have shapes (S,) and (S, N)")
    if np.shape(f) != (3, densities.shape[1]):
        raise ValueError("f must have shape (3, N)")
    if min(odds.tolist(), default=0) < 0 or not (densities >= 0).all():
        raise ValueError("odds and densities must be >= 0")
    found = np.zeros(f.shape, np.result_type(f, densities))
    for n in range(f.shape[1]):
        density = math.fsum(float(c) * float(p) for c, p in zip(odds, densities[:, n], strict=True))
        if density:
            found[:, n] = [float(value) / density for value in f[:, n]]
    return found
