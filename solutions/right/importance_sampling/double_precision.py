"""Double precision inside, cast at the end."""

import numpy as np


def uniform_hemisphere(u):
    """By the angle from the pole."""
    _check_rows("u", u, 2)
    theta = np.arccos(u[1].astype(np.float64))
    phi = 2 * np.pi * u[0].astype(np.float64)
    x, y = np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)
    return np.stack((x, y, np.cos(theta))).astype(u.dtype)


def cosine_hemisphere(u):
    """By the angle from the pole."""
    _check_rows("u", u, 2)
    theta = np.arcsin(np.sqrt(u[0].astype(np.float64)))
    phi = 2 * np.pi * u[1].astype(np.float64)
    x, y = np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi)
    return np.stack((x, y, np.cos(theta))).astype(u.dtype)


def cosine_hemisphere_pdf(cos):
    """A Phong lobe of exponent 1."""
    _check_numbers("cos", cos)
    return phong_lobe_pdf(cos, 1.0)


def phong_lobe_pdf(cos, exponent):
    """Double precision."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    wide = np.clip(cos.astype(np.float64), 0, 1)
    density = (float(exponent) + 1) / (2 * np.pi) * wide ** float(exponent)
    density[cos < 0] = 0
    return np.minimum(density, np.finfo(cos.dtype).max).astype(cos.dtype)


def estimate(f, pdf):
    """Each channel for itself."""
    _check_samples(f, pdf)
    dtype = np.result_type(f, pdf)
    found = [_one(row, pdf) for row in np.atleast_2d(f).astype(np.float64)]
    mean, variance = np.array(found).T
    if f.ndim == 1:
        return dtype.type(mean[0]), dtype.type(variance[0])
    return mean.astype(dtype), variance.astype(dtype)


def _one(f, pdf):
    x = np.zeros(len(pdf))
    x[pdf > 0] = f[pdf > 0] / pdf[pdf > 0]
    if len(x) < 2:
        return x.sum(), 0.0
    return x.mean(), np.cov(x) / len(x)


def power_heuristic(a, b):
    """Double precision, where single ones' squares fit."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_none_negative("a", a)
    _check_none_negative("b", b)
    dtype = np.result_type(a, b)
    a, b = a.astype(np.longdouble), b.astype(np.longdouble)
    total = a * a + b * b
    return (a * a / np.where(total > 0, total, 1)).astype(dtype)


def _check_samples(f, pdf):
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_none_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
