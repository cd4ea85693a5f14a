"""The textbook's formulas without a guard for special values, in the batch's own precision."""

import numpy as np


def orthonormal_basis(w):
    """The helper is the axis that w is farthest from; a vector a row, transposed."""
    _check_batch("w", w, 3)
    helper = np.eye(3, dtype=w.dtype)[np.abs(w).argmin(axis=0)]
    u = np.cross(helper, w.T)
    u /= np.linalg.norm(u, axis=1)[:, None]
    return u.T, np.cross(w.T, u).T


def jitter_on_plane(direction, roughness, u):
    """normalise(direction + roughness * ...)."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    a, b = orthonormal_basis(direction)
    d = direction + roughness * ((u[0] - 0.5) * a + (u[1] - 0.5) * b)
    return (d / np.linalg.norm(d, axis=0)).astype(np.result_type(direction, u))


def jitter_in_ball(direction, glossiness, u):
    """normalise(direction + glossiness * a point of the ball), in Fortran's order."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")
    theta, phi, r = np.arccos(2 * u[1] - 1), 2 * np.pi * u[0], u[2] ** (1 / 3)
    point = r * np.array((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)))
    d = direction + glossiness * point
    d = d / np.linalg.norm(d, axis=0)
    return np.asfortranarray(d.astype(np.result_type(direction, u)))


def sample_phong_lobe(direction, exponent, u):
    """cos^(exponent + 1) is the share outside, the sine by Pythagoras."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    a, b = orthonormal_basis(direction)
    cos = (1 - u[0]) ** (1 / (exponent + 1))
    sin = np.sqrt(1 - cos**2)
    phi = 2 * np.pi * u[1]
    d = sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * direction
    return d.astype(np.result_type(direction, u))


def keep_above(direction, normal):
    """In place on a copy."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    d = np.array(direction, np.result_type(direction, normal), order="F")
    dot = (d * normal).sum(axis=0)
    d -= 2 * np.minimum(dot, 0) * normal
    return d
