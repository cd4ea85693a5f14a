"""The batch's own precision throughout."""

import numpy as np


def diffuse_bounce(normal, u):
    """Frisvad's basis as Duff and others mended it, the concentric disk lifted."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    dtype = np.result_type(normal, u)
    a, b = 2 * u[0] - 1, 2 * u[1] - 1
    wide = np.abs(a) > np.abs(b)
    r = np.where(wide, a, b)
    ratio = np.where(wide, b, a) / np.where(r == 0, 1, r)
    angle = u.dtype.type(np.pi / 4) * ratio
    phi = np.where(wide, angle, u.dtype.type(np.pi / 2) - angle)
    px, py = r * np.cos(phi), r * np.sin(phi)
    pz = np.sqrt(np.maximum(1 - px * px - py * py, 0))
    x, y, z = normal
    s = np.where(z < 0, normal.dtype.type(-1), normal.dtype.type(1))
    k = -1 / (s + z)
    first = np.stack((1 + s * x * x * k, s * x * y * k, -s * x))
    second = np.stack((x * y * k, s + y * y * k, -y))
    return (px * first + py * second + pz * normal).astype(dtype)


def throughput(beta, albedo):
    """In one call."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return np.einsum("ij,ij->ij", albedo, beta)


def russian_roulette(beta, u):
    """By the reciprocal of the probability."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    q = np.maximum(np.maximum(beta[0], beta[1]), beta[2])
    q = np.where(q > 1, beta.dtype.type(1), q)
    survives = np.less(u, q)
    scaled = beta / np.where(survives, q, beta.dtype.type(1))
    return survives, (scaled * survives).astype(np.result_type(beta, u))
