"""As the formulae are printed, with complex roots for Fresnel; results in other layouts, cast at the end."""

import numpy as np


def refract(direction, normal, eta):
    """Total reflection put in by a mask, into a copy of the mirrored directions."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    kinds = [direction.dtype, normal.dtype]
    if np.ndim(eta) == 1:
        kinds.append(eta.dtype)
    eta = np.broadcast_to(eta, direction.shape[1:]).astype(float)
    cos_i = -np.sum(direction.astype(float) * normal, axis=0)
    k = 1 - eta**2 * (1 - cos_i**2)
    total = k < 0
    result = direction + 2 * cos_i * normal
    through = ~total
    bent = eta * direction + (eta * cos_i - np.sqrt(np.abs(k))) * normal
    result[:, through] = bent[:, through]
    return np.asfortranarray(result, np.result_type(*kinds)), total


def jitter_refraction(direction, normal, roughness, u):
    """A basis by cross products with whichever of two axes is farther; columns as rows."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)
    w = direction.T.astype(float)
    helper = np.where(np.abs(w[:, :1]) > 0.5, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    a = np.cross(helper, w)
    a /= np.linalg.norm(a, axis=1, keepdims=True)
    b = np.cross(w, a)
    jittered = w + roughness * ((u[0] - 0.5)[:, None] * a + (u[1] - 0.5)[:, None] * b)
    jittered /= np.linalg.norm(jittered, axis=1, keepdims=True)
    height = np.sum(jittered * normal.T, axis=1)
    jittered[height > 0] -= (2 * height[:, None] * normal.T)[height > 0]
    return jittered.T.astype(np.result_type(direction, normal, u))


def fresnel(cos_i, eta):
    """Complex amplitudes; along the surface all is reflected."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    dtype = np.result_type(cos_i, eta) if np.ndim(eta) else cos_i.dtype
    c = np.clip(cos_i, 0, 1).astype(complex)
    t = np.sqrt(1 - np.asarray(eta, float) ** 2 * (1 - c * c))
    with np.errstate(invalid="ignore"):
        s, p = (eta * c - t) / (eta * c + t), (c - eta * t) / (c + eta * t)
    both = (np.abs(s) ** 2 + np.abs(p) ** 2) / 2
    return np.where(c == 0, 1, both).astype(dtype)
