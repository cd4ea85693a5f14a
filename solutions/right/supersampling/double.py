"""Everything in float64, and cast at the very end."""

import numpy as np


def regular(k, n):
    """Centres from linspace."""
    _check_counts(k, n)
    half = 1 / (2 * k)
    centre = np.linspace(half, 1 - half, k)
    y, x = np.meshgrid(centre, centre, indexing="ij")
    points = np.stack((x.ravel(), y.ravel()))
    return np.tile(points[:, np.newaxis, :], (1, n, 1)).astype(np.float32)


def random(k, n, rng):
    """Points as they are drawn, (n, k * k, 2), seen from the other side."""
    _check_counts(k, n)
    return rng.random((n, k * k, 2)).transpose(2, 0, 1).astype(np.float32)


def jittered(k, n, rng):
    """Centres, moved by up to half a cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    centre = np.stack((number % k + 0.5, number // k + 0.5))[:, None, :] / k
    shift = rng.uniform(-0.5, 0.5, (2, n, k * k)) / k
    return np.maximum(centre + shift, 0).astype(np.float32)


def gaussian_weights(offsets, sigma=1 / 6):
    """Product of a Gaussian in x and one in y."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    z = (offsets.astype(np.float64) - 0.5) / max(float(sigma), 1e-100)
    gx, gy = np.exp(-0.5 * z * z)
    return (gx * gy).astype(offsets.dtype)


def resolve(radiance, weights):
    """Weights first made to sum to one."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    w = weights.astype(np.float64)
    w[w.sum(axis=1) == 0] = 1
    w /= np.maximum(w.shape[1], 1) * 1.0
    total = w.sum(axis=1, keepdims=True)
    share = np.divide(w, total, out=np.zeros_like(w), where=total != 0)
    return (radiance * share).sum(axis=2).astype(np.result_type(radiance, weights))
