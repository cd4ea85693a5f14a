"""Plain Python, one number at a time, in double precision."""

import numpy as np


def uniform_hemisphere(u):
    """The first number for the turn."""
    _check_rows("u", u, 2)
    result = np.empty((3, u.shape[1]), u.dtype)
    for i in range(u.shape[1]):
        z, phi = 1 - float(u[1, i]), 2 * np.pi * float(u[0, i])
        ring = (1 - z * z) ** 0.5
        result[:, i] = ring * np.cos(phi), ring * np.sin(phi), z
    return result


def cosine_hemisphere(u):
    """The cosine is the root of a uniform number."""
    _check_rows("u", u, 2)
    result = np.empty((3, u.shape[1]), u.dtype)
    for i in range(u.shape[1]):
        z, phi = float(u[0, i]) ** 0.5, -2 * np.pi * float(u[1, i])
        ring = (1 - z * z) ** 0.5
        result[:, i] = ring * np.sin(phi), ring * np.cos(phi), z
    return result


def cosine_hemisphere_pdf(cos):
    """One cosine at a time."""
    _check_numbers("cos", cos)
    return np.array([max(c, 0.0) / np.pi for c in cos.tolist()], cos.dtype)


def phong_lobe_pdf(cos, exponent):
    """One cosine at a time."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    largest = float(np.finfo(cos.dtype).max)
    result = np.zeros_like(cos)
    for i, c in enumerate(cos.tolist()):
        if c >= 0:
            result[i] = min((exponent + 1) / (2 * np.pi) * c ** float(exponent), largest)
    return result


def estimate(f, pdf):
    """Welford's running mean and variance."""
    _check_samples(f, pdf)
    dtype = np.result_type(f, pdf)
    mean, squares = np.zeros(f.shape[:-1]), np.zeros(f.shape[:-1])
    n = 0
    for i in range(len(pdf)):
        x = f[..., i] / float(pdf[i]) if pdf[i] > 0 else np.zeros(f.shape[:-1])
        n += 1
        off = x - mean
        mean = mean + off / n
        squares = squares + off * (x - mean)
    variance = squares / (n - 1) / n if n > 1 else 0 * squares
    return np.asarray(mean, dtype)[()], np.asarray(variance, dtype)[()]


def power_heuristic(a, b):
    """One pair at a time."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_none_negative("a", a)
    _check_none_negative("b", b)
    result = np.zeros(len(a), np.result_type(a, b))
    for i, (x, y) in enumerate(zip(a.tolist(), b.tolist(), strict=True)):
        if x > 0:
            largest = max(x, y)
            x, y = x / largest, y / largest
            result[i] = x * x / (x * x + y * y)
    return result


def _check_samples(f, pdf):
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_none_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
