"""The textbook's formulae in double precision, cast at the end."""

import numpy as np


def refract(direction, normal, eta):
    """Eta d + (eta cos_i - cos_t) n."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    arrays = (direction, normal, eta) if np.ndim(eta) else (direction, normal)
    dtype = np.result_type(*arrays)
    d, n, eta = (np.asarray(x, float) for x in (direction, normal, eta))
    d = d / np.linalg.norm(d, axis=0)
    n = n / np.linalg.norm(n, axis=0)
    cos_i = -(d * n).sum(axis=0)
    sin2 = eta**2 * (1 - cos_i**2)
    total = sin2 > 1
    cos_t = np.sqrt(np.maximum(1 - sin2, 0))
    bent = eta * d + (eta * cos_i - cos_t) * n
    return np.where(total, d + 2 * cos_i * n, bent).astype(dtype), total


def jitter_refraction(direction, normal, roughness, u):
    """Gram-Schmidt against the normal, the square turned with it; mirrored by a mask."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, normal, u)
    if roughness == 0:
        return direction.astype(dtype)
    w = direction.astype(float)
    w /= np.linalg.norm(w, axis=0)
    flat = np.abs((w * normal).sum(axis=0)) > 0.999
    axis = np.where(np.abs(w[0]) > 0.9, np.array([[0.0], [1.0], [0.0]]), np.eye(3)[:, :1])
    helper = np.where(flat, axis, normal)
    a = helper - (helper * w).sum(axis=0) * w
    a /= np.linalg.norm(a, axis=0)
    b = np.cross(a, w, axis=0)
    x, y = float(roughness) * (u[::-1].astype(float) - 0.5)
    jittered = w + x * a + y * b
    jittered /= np.linalg.norm(jittered, axis=0)
    above = (jittered * normal).sum(axis=0) > 0
    dot = (jittered * normal).sum(axis=0)
    jittered[:, above] -= 2 * (dot * normal)[:, above]
    return jittered.astype(dtype)


def fresnel(cos_i, eta):
    """By angles, as in the book; straight on by its limit."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    arrays = (cos_i, eta) if np.ndim(eta) else (cos_i,)
    dtype = np.result_type(*arrays)
    eta = np.broadcast_to(np.asarray(eta, float), cos_i.shape)
    c = np.clip(np.asarray(cos_i, float), 0, 1)
    result = np.ones(c.shape)
    sine = eta * np.sqrt(1 - c * c)
    through = (sine < 1) & (c > 0)
    i, t = np.arccos(c[through]), np.arcsin(sine[through])
    straight = i + t < 1e-5
    i, t = np.where(straight, 1, i), np.where(straight, 1, t)
    s, p = np.sin(i - t) / np.sin(i + t), np.tan(i - t) / np.tan(i + t)
    limit = ((eta - 1) / (eta + 1))[through]
    s, p = np.where(straight, limit, s), np.where(straight, limit, p)
    result[through] = (s * s + p * p) / 2
    return result.astype(dtype)
