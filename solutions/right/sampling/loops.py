"""Plain Python, one point and one number at a time."""

import numpy as np


def disk_by_rejection(n, rng):
    """Two numbers at a time."""
    _check_count(n)
    points = np.empty((2, n), np.float32)
    for i in range(n):
        while True:
            x, y = 2 * rng.random() - 1, 2 * rng.random() - 1
            if x * x + y * y <= 1:
                break
        points[:, i] = x, y
    return points


def ball_by_rejection(n, rng):
    """Three numbers at a time."""
    _check_count(n)
    points = np.empty((3, n), np.float32)
    for i in range(n):
        while True:
            x, y, z = rng.random(), rng.random(), rng.random()
            x, y, z = 2 * x - 1, 2 * y - 1, 2 * z - 1
            if x * x + y * y + z * z <= 1:
                break
        points[:, i] = x, y, z
    return points


def disk_by_polar(u):
    """The first number for the angle, the second for the radius."""
    _check_batch("u", u, 2)
    points = np.empty_like(u)
    for i in range(u.shape[1]):
        r, phi = float(u[1, i]) ** 0.5, 2 * np.pi * float(u[0, i])
        points[:, i] = r * np.sin(phi), r * np.cos(phi)
    return points


def ball_by_polar(u):
    """As the seed writes it."""
    _check_batch("u", u, 3)
    points = np.empty_like(u)
    for i in range(u.shape[1]):
        height, phi = 2 * float(u[0, i]) - 1, 2 * np.pi * float(u[1, i])
        r = float(u[2, i]) ** (1 / 3)
        ring = r * (1 - height * height) ** 0.5
        points[:, i] = ring * np.cos(phi), ring * np.sin(phi), r * height
    return points


def sphere_by_polar(u):
    """As the ball, with radius 1."""
    _check_batch("u", u, 2)
    return ball_by_polar(np.concatenate((u, np.ones_like(u[:1]))))


def xorshift32(state):
    """Whole numbers of Python."""
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
    new = np.empty_like(state)
    for i, x in enumerate(state.tolist()):
        x = (x ^ (x << 13)) & 0xFFFFFFFF
        x ^= x >> 17
        x = (x ^ (x << 5)) & 0xFFFFFFFF
        new[i] = x
    return new, np.minimum((new / 2**32).astype(np.float32), np.float32(1 - 2**-24))
