"""Plain Python, one path at a time, in double precision."""

import numpy as np


def diffuse_bounce(normal, u):
    """A tangent from the axis that the normal is farthest from."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    result = np.empty(normal.shape, np.result_type(normal, u))
    for i in range(u.shape[1]):
        n = normal[:, i].astype(np.float64)
        axis = np.zeros(3)
        axis[np.argmin(np.abs(n))] = 1
        s = np.cross(n, axis)
        s /= np.linalg.norm(s)
        t = np.cross(s, n)
        cos, phi = float(1 - u[1, i]) ** 0.5, -2 * np.pi * float(u[0, i])
        sin = (1 - cos * cos) ** 0.5
        result[:, i] = sin * (np.cos(phi) * s + np.sin(phi) * t) + cos * n
    return result


def throughput(beta, albedo):
    """f cos / pdf for a cosine of 1/2, written out."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    result = np.empty(beta.shape, np.result_type(beta, albedo))
    for i in range(beta.shape[1]):
        for k in range(3):
            f, cos = float(albedo[k, i]) / np.pi, 0.5
            result[k, i] = float(beta[k, i]) * f * cos / (cos / np.pi)
    return result


def russian_roulette(beta, u):
    """One game at a time."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    survives = np.zeros(len(u), np.bool_)
    result = np.zeros(beta.shape, np.result_type(beta, u))
    for i in range(len(u)):
        q = min(max(float(channel) for channel in beta[:, i]), 1.0)
        if float(u[i]) < q:
            survives[i] = True
            result[:, i] = [float(channel) / q for channel in beta[:, i]]
    return survives, result
