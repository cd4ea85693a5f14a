"""Single precision as it comes: bent and mirrored apart, a square turned by 45 degrees."""

import numpy as np


def refract(direction, normal, eta):
    """Both directions for all rays, one of them chosen; brought to length 1."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    if not np.ndim(eta):
        eta = np.result_type(direction, normal).type(eta)
    cos_i = np.minimum(-(direction * normal).sum(axis=0), 1)
    sin_t = eta * np.sqrt(1 - cos_i * cos_i)
    total = sin_t > 1
    cos_t = np.sqrt(1 - np.minimum(sin_t, 1) ** 2)
    bent = eta * (direction + cos_i * normal) - cos_t * normal
    bent = np.where(total, direction + 2 * cos_i * normal, bent)
    return bent / np.sqrt((bent * bent).sum(axis=0)), total


def jitter_refraction(direction, normal, roughness, u):
    """Hughes and Moeller's basis; signs instead of masks."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    dtype = np.result_type(direction, normal, u)
    x, y, z = direction
    zero = np.zeros_like(x)
    a = np.where(np.abs(x) > np.abs(z), np.stack((-y, x, zero)), np.stack((zero, -z, y)))
    a = a / np.sqrt((a * a).sum(axis=0))
    b = np.stack((y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0]))
    side = dtype.type(roughness * 0.5**0.5)
    s, t = side * (u[0] - u[1]), side * (u[0] + u[1] - 1)
    jittered = (direction + s * a + t * b) / np.sqrt(1 + s * s + t * t)
    dot = (jittered * normal).sum(axis=0)
    jittered = jittered - (dot + np.abs(dot)) * normal
    return np.where(roughness == 0, direction, jittered).astype(dtype)


def fresnel(cos_i, eta):
    """Fresnel's formulae as Glassner's: with g^2 = 1 / eta^2 - 1 + c^2."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    if not np.ndim(eta):
        eta = cos_i.dtype.type(eta)
    c = np.clip(cos_i, 0, 1)
    square = 1 / (eta * eta) - 1 + c * c
    total = square <= 0
    g = np.sqrt(np.where(total, 1, square))
    a = (g - c) / (g + c)
    b = (c * (g + c) - 1) / (c * (g - c) + 1)
    return np.where(total, 1, a * a / 2 * (1 + b * b))
