"""Only what was rejected is drawn again; warps with the rows the other way round."""

import numpy as np


def disk_by_rejection(n, rng):
    """Until none is outside."""
    return _redrawn(2, n, rng)


def ball_by_rejection(n, rng):
    """Until none is outside."""
    return _redrawn(3, n, rng)


def _redrawn(rows, n, rng):
    _check_count(n)
    points = rng.uniform(-1, 1, (rows, n))
    outside = np.linalg.norm(points, axis=0) >= 1
    while outside.any():
        points[:, outside] = rng.uniform(-1, 1, (rows, int(outside.sum())))
        outside = np.linalg.norm(points, axis=0) >= 1
    return points.astype(np.float32)


def disk_by_polar(u):
    """Complex numbers."""
    _check_batch("u", u, 2)
    z = np.sqrt(1 - u[1]) * np.exp(2j * np.pi * u[0])
    return np.stack((z.real, z.imag)).astype(u.dtype)


def ball_by_polar(u):
    """A power of 1/3."""
    _check_batch("u", u, 3)
    return (u[0] ** (1 / 3) * sphere_by_polar(u[1:])).astype(u.dtype)


def sphere_by_polar(u):
    """An angle from the pole whose cosine is uniform."""
    _check_batch("u", u, 2)
    theta = np.arccos(2 * u[1] - 1)
    phi = 2 * np.pi * u[0]
    points = (np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi))
    return np.stack(points).astype(u.dtype)


def xorshift32(state):
    """64 bits, cut off after each shift."""
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
    wide = state.astype(np.uint64)
    wide = (wide ^ (wide << np.uint64(13))) & np.uint64(0xFFFFFFFF)
    wide = wide ^ (wide >> np.uint64(17))
    wide = (wide ^ (wide << np.uint64(5))) & np.uint64(0xFFFFFFFF)
    return wide.astype(np.uint32), (wide // 256 / 2.0**24).astype(np.float32)
