"""Single precision as it comes, with a concentric disk and a ball from a direction and a length."""

import numpy as np


def orthonormal_basis(w):
    """Hughes and Moeller: swap two components, negate one."""
    _check_batch("w", w, 3)
    x, y, z = w
    zero = np.zeros_like(x)
    a = np.where(np.abs(x) > np.abs(z), np.stack((-y, x, zero)), np.stack((zero, -z, y)))
    a = a / np.sqrt((a * a).sum(axis=0))
    b = np.stack((y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0]))
    return a, b


def jitter_on_plane(direction, roughness, u):
    """The square turned by 45 degrees."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, u)
    a, b = orthonormal_basis(direction)
    half = dtype.type(0.5)
    side = dtype.type(roughness * 0.5**0.5)
    x, y = side * (u[0] - u[1]), side * (u[0] + u[1] - 2 * half)
    offset = x * a + y * b
    length = np.sqrt(1 + x * x + y * y)
    jittered = (direction + offset) / length
    return np.where(roughness == 0, direction, jittered).astype(dtype)


def _concentric(u):
    """Shirley and Chiu: squares to rings."""
    x, y = 2 * u - 1
    wide = np.abs(x) > np.abs(y)
    r = np.where(wide, x, y)
    safe = np.where(r == 0, 1, r)
    quarter = u.dtype.type(np.pi / 4)
    phi = np.where(wide, quarter * (y / safe), 2 * quarter - quarter * (x / safe))
    return r, phi.astype(u.dtype)


def jitter_in_ball(direction, glossiness, u):
    """The sphere by an area-preserving map of the concentric disk."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    dtype = np.result_type(direction, u)
    if glossiness == 0:
        return direction.astype(dtype)
    r, phi = _concentric(u[1:])
    z = 1 - 2 * r * r
    ring = 2 * r * np.sqrt(np.maximum(1 - r * r, 0))
    point = np.cbrt(1 - u[0]) * np.stack((z, ring * np.cos(phi), ring * np.sin(phi)))
    jittered = direction + dtype.type(glossiness) * point
    return (jittered / np.sqrt((jittered * jittered).sum(axis=0))).astype(dtype)


def sample_phong_lobe(direction, exponent, u):
    """The concentric disk's r^2 for the share."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    dtype = np.result_type(direction, u)
    r, phi = _concentric(u)
    cos = np.maximum(1 - r * r, 0) ** dtype.type(1 / (exponent + 1))
    sin = np.sqrt(np.maximum(1 - cos * cos, 0)) * np.sign(r)
    a, b = orthonormal_basis(direction)
    return (sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * direction).astype(dtype)


def keep_above(direction, normal):
    """By choosing between the two."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    dtype = np.result_type(direction, normal)
    dot = direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]
    return np.where(dot >= 0, direction, direction - (dot + dot) * normal).astype(dtype)
