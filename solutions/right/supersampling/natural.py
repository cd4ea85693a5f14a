"""The textbook's lines: meshgrid, broadcasting and einsum; results in Fortran's order or as views."""

import numpy as np


def regular(k, n):
    """A view of one pixel's points."""
    _check_counts(k, n)
    x, y = np.meshgrid((np.arange(k) + 0.5) / k, (np.arange(k) + 0.5) / k)
    one = np.array((x.ravel(), y.ravel()), np.float32)
    return np.broadcast_to(one[:, None, :], (2, n, k * k))


def random(k, n, rng):
    """x and y one after the other."""
    _check_counts(k, n)
    x = rng.random((n, k * k))
    y = rng.random((n, k * k))
    return np.asfortranarray(np.array((x, y), np.float32))


def jittered(k, n, rng):
    """Cells' numbers and a uniform number each."""
    _check_counts(k, n)
    i = np.arange(k * k)
    x = (i % k + rng.random((n, k * k))) / k
    y = (i // k + rng.random((n, k * k))) / k
    return np.stack((x, y)).astype(np.float32)


def gaussian_weights(offsets, sigma=1 / 6):
    """As it is written in books."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    r2 = ((offsets - 0.5) ** 2).sum(axis=0)
    return np.exp(-r2 / (2 * sigma**2)).astype(offsets.dtype)


def resolve(radiance, weights):
    """Sum over sum."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    dtype = np.result_type(radiance, weights)
    if radiance.shape[2] == 0:
        return np.zeros(radiance.shape[:2], dtype)
    total = weights.sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = np.einsum("cns,ns->cn", radiance, weights) / total
    return np.where(total == 0, radiance.mean(axis=2), mean).astype(dtype)
