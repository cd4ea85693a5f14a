"""The most natural form: points one after the other into lists and transposed; formulas as they stand in a textbook."""

import numpy as np


def disk_by_rejection(n, rng):
    """A list of rows."""
    return _listed(2, n, rng)


def ball_by_rejection(n, rng):
    """A list of rows."""
    return _listed(3, n, rng)


def _listed(rows, n, rng):
    _check_count(n)
    kept = []
    while len(kept) < n:
        more = rng.uniform(-1, 1, (2 * n, rows))
        kept += [row for row in more if row @ row < 1]
    return np.array(kept[:n], np.float32).reshape(n, rows).T


def disk_by_polar(u):
    """Radius and angle."""
    _check_batch("u", u, 2)
    r, phi = np.sqrt(u[0]), 2 * np.pi * u[1]
    return np.array([r * np.cos(phi), r * np.sin(phi)])


def ball_by_polar(u):
    """Radius, height and angle."""
    _check_batch("u", u, 3)
    r, z, phi = np.cbrt(u[0]), 2 * u[1] - 1, 2 * np.pi * u[2]
    ring = np.sqrt(1 - z**2)
    return r * np.array([ring * np.cos(phi), ring * np.sin(phi), z])


def sphere_by_polar(u):
    """Height and angle, into a result of Fortran's order."""
    _check_batch("u", u, 2)
    points = np.empty((3, u.shape[1]), u.dtype, order="F")
    points[2] = 2 * u[0] - 1
    ring, phi = np.sqrt(1 - points[2] ** 2), 2 * np.pi * u[1]
    points[0], points[1] = ring * np.cos(phi), ring * np.sin(phi)
    return points


def xorshift32(state):
    """As Marsaglia writes it, and the upper 24 bits."""
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
    x = state.copy()
    x ^= x << 13
    x ^= x >> 17
    x ^= x << 5
    return x, (x >> 8).astype(np.float32) / np.float32(2**24)
