"""Ratios as differences of logarithms, and sums by np.add.at and einsum."""

import numpy as np


def cone_density(radius, distance):
    """By the tangent of half the angle."""
    if not radius > 0:
        raise ValueError("radius must be > 0")
    if np.ndim(distance) != 1:
        raise ValueError("distance must have shape (N,)")
    far = np.flatnonzero(distance > radius)
    ratio = distance[far].astype(float) / float(radius)
    # sin / (1 + cos), and 1 - cos is sin times it.
    half = 1 / (ratio + np.sqrt((ratio - 1) * (ratio + 1)))
    density = np.zeros(len(distance))
    density[far] = ratio / half / (2 * np.pi)
    return density.astype(distance.dtype)


def heuristic_weights(counts, densities, exponent):
    """The softmax of exponent times the logarithm."""
    if np.ndim(counts) != 1 or np.ndim(densities) != 2 or len(densities) != len(counts):
        raise ValueError("counts and densities must have shapes (S,) and (S, N)")
    if (np.array(counts) < 0).any() or not (densities >= 0).all() or not exponent >= 1:
        raise ValueError("counts and densities must be >= 0, exponent >= 1")
    with np.errstate(divide="ignore", invalid="ignore"):
        height = exponent * (np.log(densities.astype(float)).T + np.log(counts)).T
        raised = np.exp(height - height.max(axis=0))
        shares = raised / raised.sum(axis=0)
    return np.nan_to_num(shares).astype(densities.dtype)


def delta_weights(counts, densities, delta):
    """Two passes: all by densities, then the samples that a delta draws anew."""
    if np.ndim(counts) != 1 or np.ndim(densities) != 2 or len(densities) != len(counts):
        raise ValueError("counts and densities must have shapes (S,) and (S, N)")
    if np.shape(delta) != np.shape(densities):
        raise ValueError("delta must have the shape of densities")
    if (np.array(counts) < 0).any() or not (densities >= 0).all():
        raise ValueError("counts and densities must be >= 0")
    product = np.einsum("s,sn->sn", np.array(counts, float), densities)
    deltas = np.multiply(product, delta)
    met = deltas.sum(axis=0) > 0
    product[:, met] = deltas[:, met]
    return np.divide(
        product, product.sum(axis=0), out=np.zeros_like(product), where=product > 0
    ).astype(densities.dtype)


def multi_sample(counts, strategy, f, densities, weights):
    """A sum for each strategy, and then their averages."""
    if np.ndim(counts) != 1 or np.ndim(f) != 2 or len(f) != 3:
        raise ValueError("counts and f must have shapes (S,) and (3, N)")
    if not np.shape(strategy) == np.shape(densities) == np.shape(weights) == np.shape(f)[1:]:
        raise ValueError("strategy, densities and weights must have shape (N,)")
    some = np.flatnonzero(densities)
    sums = np.zeros((len(counts), 3))
    np.add.at(
        sums, strategy[some], (f[:, some] * (weights[some] / densities[some].astype(float))).T
    )
    return np.einsum("sc,s->c", sums, 1 / counts).astype(np.result_type(f, densities, weights))
