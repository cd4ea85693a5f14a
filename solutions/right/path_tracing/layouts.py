"""Results in other memory layouts, views, and work in place on copies of its own."""

import numpy as np


def diffuse_bounce(normal, u):
    """A basis by the longest of two cross products, a direction a row, transposed."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    n = normal.T.astype(np.result_type(normal, u))
    s = np.cross(n, np.where(np.abs(n[:, :1]) > 0.5, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)))
    s /= np.linalg.norm(s, axis=1, keepdims=True)
    t = np.cross(n, s)
    phi = 2 * np.pi * u[0]
    s *= np.cos(phi)[:, None]
    s += np.sin(phi)[:, None] * t
    s *= np.sqrt(u[1])[:, None]
    s += np.sqrt(1 - u[1])[:, None] * n
    return s.astype(n.dtype).T


def throughput(beta, albedo):
    """In place on a copy in Fortran's order."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    left = np.array(beta, np.result_type(beta, albedo), order="F")
    left *= albedo
    return left


def russian_roulette(beta, u):
    """A path a row, and a part of a larger array."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    q = beta.T.max(axis=1)
    q[q > 1] = 1
    rows = np.zeros((len(u), 5), np.result_type(beta, u))
    survives = u < q
    rows[survives, 1:4] = (beta[:, survives] / q[survives]).T
    return survives, rows[:, 1:4].T
