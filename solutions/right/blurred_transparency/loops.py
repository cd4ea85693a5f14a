"""Plain Python, one ray at a time."""

import numpy as np


def refract(direction, normal, eta):
    """Snell's law for each ray."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    arrays = (direction, normal, eta) if np.ndim(eta) else (direction, normal)
    n = direction.shape[1]
    result = np.empty((3, n), np.result_type(*arrays))
    total = np.zeros(n, bool)
    for k in range(n):
        d, m = direction[:, k].astype(float), normal[:, k].astype(float)
        e = float(eta[k]) if np.ndim(eta) else float(eta)
        cos_i = -float(d @ m)
        square = 1 - e * e * (1 - cos_i * cos_i)
        if square < 0:
            total[k] = True
            result[:, k] = d + 2 * cos_i * m
        else:
            result[:, k] = e * d + (e * cos_i - square**0.5) * m
    return result, total


def jitter_refraction(direction, normal, roughness, u):
    """The square for each ray, in cross products with the axis that it is farthest from."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    result = np.empty(direction.shape, np.result_type(direction, normal, u))
    for k in range(direction.shape[1]):
        d, m = direction[:, k].astype(float), normal[:, k].astype(float)
        if roughness > 0:
            a = np.cross(np.eye(3)[np.abs(d).argmin()], d)
            a /= np.sqrt(a @ a)
            b = np.cross(d, a)
            x, y = float(roughness) * (u[:, k].astype(float) - 0.5)
            d = d + x * a + y * b
            d /= np.sqrt(d @ d)
            if d @ m > 0:
                d -= 2 * (d @ m) * m
        result[:, k] = d
    return result


def fresnel(cos_i, eta):
    """Fresnel's formulae for each ray."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    arrays = (cos_i, eta) if np.ndim(eta) else (cos_i,)
    result = np.ones(len(cos_i), np.result_type(*arrays))
    for k, c in enumerate(cos_i.astype(float)):
        e = float(eta[k]) if np.ndim(eta) else float(eta)
        c = min(max(float(c), 0.0), 1.0)
        square = 1 - e * e * (1 - c * c)
        if square > 0:
            t = square**0.5
            s, p = (e * c - t) / (e * c + t), (c - e * t) / (c + e * t)
            result[k] = (s * s + p * p) / 2
    return result
