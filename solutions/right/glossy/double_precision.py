"""Gram-Schmidt in double precision, cast at the end."""

import numpy as np


def orthonormal_basis(w):
    """Gram-Schmidt from x or y."""
    _check_batch("w", w, 3)
    a, b = _gram_schmidt(w)
    return a.astype(w.dtype), b.astype(w.dtype)


def _gram_schmidt(w):
    w = _normalised(w.astype(np.float64))
    helper = np.where(np.abs(w[0]) > 0.9, np.array([[0.0], [1.0], [0.0]]), np.eye(3)[:, :1])
    a = _normalised(helper - (helper * w).sum(axis=0) * w)
    return a, np.cross(w.T, a.T).T


def _normalised(v):
    return v / np.linalg.norm(v, axis=0)


def jitter_on_plane(direction, roughness, u):
    """The square as it stands in the text."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    if roughness == 0:
        return direction.astype(np.result_type(direction, u))
    a, b = _gram_schmidt(direction)
    x, y = float(roughness) * (u.astype(np.float64) - 0.5)
    jittered = _normalised(direction + x * a + y * b)
    return jittered.astype(np.result_type(direction, u))


def jitter_in_ball(direction, glossiness, u):
    """A sphere around the direction's own basis, filled by the cube root."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    if glossiness == 0:
        return direction.astype(np.result_type(direction, u))
    a, b = _gram_schmidt(direction)
    x, y, z = u.astype(np.float64)
    theta = np.arccos(1 - 2 * y)
    phi = 2 * np.pi * z
    point = np.sin(theta) * (np.cos(phi) * a + np.sin(phi) * b) + np.cos(theta) * direction
    jittered = direction + float(glossiness) * x ** (1 / 3) * point
    return _normalised(jittered).astype(np.result_type(direction, u))


def sample_phong_lobe(direction, exponent, u):
    """By the angle itself."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    a, b = _gram_schmidt(direction)
    alpha = np.arccos(u[0].astype(np.float64) ** (1 / (float(exponent) + 1)))
    phi = 2 * np.pi * u[1].astype(np.float64)
    lobe = np.sin(alpha) * (np.cos(phi) * a + np.sin(phi) * b) + np.cos(alpha) * direction
    return lobe.astype(np.result_type(direction, u))


def keep_above(direction, normal):
    """Mirror those that are chosen."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    result = direction.astype(np.result_type(direction, normal))
    dot = np.einsum("ij,ij->j", direction.astype(np.float64), normal.astype(np.float64))
    below = dot < 0
    result[:, below] = direction[:, below] - 2 * dot[below] * normal[:, below]
    return result
