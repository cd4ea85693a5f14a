"""The batch's own precision throughout."""

import numpy as np


def uniform_hemisphere(u):
    """From the whole sphere, with the lower half turned up."""
    _check_rows("u", u, 2)
    z = 1 - 2 * u[0]
    ring = 2 * np.sqrt(u[0] * (1 - u[0]))
    phi = u.dtype.type(2 * np.pi) * u[1]
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), np.abs(z)))


def cosine_hemisphere(u):
    """A uniform sphere that touches the pole's unit vector, normalised."""
    _check_rows("u", u, 2)
    r, phi = np.sqrt(1 - u[1]), u.dtype.type(2 * np.pi) * u[0]
    x, y = r * np.sin(phi), r * np.cos(phi)
    return np.stack((x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0))))


def cosine_hemisphere_pdf(cos):
    """Clipped."""
    _check_numbers("cos", cos)
    return (np.clip(cos, 0, None) / np.pi).astype(cos.dtype)


def phong_lobe_pdf(cos, exponent):
    """By the logarithm."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    exponent = cos.dtype.type(min(exponent, float(np.finfo(cos.dtype).max)))
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        power = np.exp(exponent * np.log(np.clip(cos, 0, 1))) if exponent > 0 else np.ones_like(cos)
    density = (exponent + 1) / cos.dtype.type(2 * np.pi) * power
    return np.where(cos >= 0, density, 0).astype(cos.dtype)


def estimate(f, pdf):
    """NumPy's mean and variance."""
    _check_samples(f, pdf)
    dtype = np.result_type(f, pdf)
    if len(pdf) == 0:
        return np.zeros(f.shape[:-1], dtype), np.zeros(f.shape[:-1], dtype)
    x = np.divide(f, pdf, out=np.zeros(f.shape, dtype), where=pdf != 0)
    mean = x.mean(axis=-1)
    if len(pdf) == 1:
        return mean, 0 * mean
    return mean, x.var(axis=-1, ddof=1) / dtype.type(len(pdf))


def power_heuristic(a, b):
    """The larger of the two to 1."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_none_negative("a", a)
    _check_none_negative("b", b)
    largest = np.maximum(a, b)
    largest = np.where(largest > 0, largest, 1).astype(largest.dtype)
    x, y = a / largest, b / largest
    return x * x / np.maximum(x * x + y * y, np.finfo(largest.dtype).tiny)


def _check_samples(f, pdf):
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_none_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
