"""Double precision inside, cast at the end."""

import numpy as np


def diffuse_bounce(normal, u):
    """The normal and a point of the unit sphere, added up and normalised."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    n, v = normal.astype(np.float64), u.astype(np.float64)
    z, phi = 2 * v[0] - 1, 2 * np.pi * v[1]
    ring = np.sqrt((1 - z) * (1 + z))
    total = n + np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
    length = np.linalg.norm(total, axis=0)
    # Opposite to the normal there is nothing left of it.
    kept = length > 1e-6
    total = np.where(kept, total, n) / np.where(kept, length, np.linalg.norm(n, axis=0))
    return total.astype(np.result_type(normal, u))


def throughput(beta, albedo):
    """Row by row."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    rows = [b.astype(np.float64) * a for b, a in zip(beta, albedo)]
    return np.array(rows).astype(np.result_type(beta, albedo))


def russian_roulette(beta, u):
    """Survivors are gathered, divided and put back."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    q = np.clip(np.amax(beta.astype(np.float64), axis=0), 0, 1)
    which = np.flatnonzero(u < q)
    survives = np.zeros(u.shape, np.bool_)
    survives[which] = True
    result = np.zeros(beta.shape, np.result_type(beta, u))
    result[:, which] = beta[:, which] / q[which]
    return survives, result
