"""All n drawn again and again until as many are inside; Shirley and Chiu's disk."""

import numpy as np


def disk_by_rejection(n, rng):
    """n candidates at a time."""
    return _batches(2, n, rng)


def ball_by_rejection(n, rng):
    """n candidates at a time."""
    return _batches(3, n, rng)


def _batches(rows, n, rng):
    _check_count(n)
    points = np.empty((rows, 0), np.float32)
    while points.shape[1] < n:
        more = 1 - 2 * rng.random((n, rows), np.float32).T
        points = np.hstack((points, more[:, (more**2).sum(axis=0) < 1]))
    return points[:, :n]


def disk_by_polar(u):
    """Rings of squares to rings of circles."""
    _check_batch("u", u, 2)
    x, y = 2 * u - 1
    wide = np.abs(x) > np.abs(y)
    r = np.where(wide, x, y)
    safe = np.where(r == 0, 1, r)
    quarter = u.dtype.type(np.pi / 4)
    phi = np.where(wide, quarter * (y / safe), 2 * quarter - quarter * (x / safe))
    return np.stack((r * np.cos(phi), r * np.sin(phi))).astype(u.dtype)


def ball_by_polar(u):
    """The shells of points on the sphere."""
    _check_batch("u", u, 3)
    return sphere_by_polar(u[::2]) * u[1] ** u.dtype.type(1 / 3)


def sphere_by_polar(u):
    """Lambert's projection of the disk: equal areas."""
    _check_batch("u", u, 2)
    x, y = disk_by_polar(u)
    squared = np.minimum(x * x + y * y, u.dtype.type(1))
    scale = 2 * np.sqrt(1 - squared)
    return np.stack((x * scale, y * scale, 1 - 2 * squared))


def xorshift32(state):
    """With one array for all shifts."""
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
    new = state.copy()
    for shift, moved in ((13, np.left_shift), (17, np.right_shift), (5, np.left_shift)):
        new ^= moved(new, np.uint32(shift))
    return new, np.ldexp((new >> np.uint32(8)).astype(np.float32), -24)
