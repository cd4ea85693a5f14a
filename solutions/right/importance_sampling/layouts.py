"""Results in other memory layouts, views, and work in place on copies of its own."""

import numpy as np


def uniform_hemisphere(u):
    """A transposed view of an array with a direction a row."""
    _check_rows("u", u, 2)
    z, turn = u
    rows = np.empty((u.shape[1], 3), u.dtype)
    rows[:, 2] = 1 - z
    rows[:, 0] = np.cos(2 * np.pi * turn)
    rows[:, 1] = np.sin(2 * np.pi * turn)
    rows[:, :2] *= np.sqrt(z * (2 - z))[:, None]
    return rows.T


def cosine_hemisphere(u):
    """Fortran's order."""
    _check_rows("u", u, 2)
    found = np.empty((3, u.shape[1]), u.dtype, order="F")
    np.sqrt(u[0], out=found[0])
    np.sqrt(1 - u[0], out=found[2])
    found[1] = found[0]
    found[0] *= np.cos(2 * np.pi * u[1])
    found[1] *= np.sin(2 * np.pi * u[1])
    return found


def cosine_hemisphere_pdf(cos):
    """In place on a copy."""
    _check_numbers("cos", cos)
    density = cos.copy()
    density[density < 0] = 0
    density /= np.pi
    return density


def phong_lobe_pdf(cos, exponent):
    """Every other number of a larger array."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    wide = np.zeros(2 * len(cos), cos.dtype)
    above = cos >= 0
    wide[::2][above] = (exponent + 1) / (2 * np.pi) * cos[above] ** exponent
    return wide[::2]


def estimate(f, pdf):
    """Samples down, channels across."""
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_none_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
    value = np.zeros(f.T.shape, np.result_type(f, pdf))
    value[pdf > 0] = (f[..., pdf > 0] / pdf[pdf > 0]).T
    n = len(value)
    mean = value.sum(axis=0) / max(n, 1)
    value -= mean
    return mean, (value**2).sum(axis=0) / max(n * (n - 1), 1)


def power_heuristic(a, b):
    """The textbook's formula where a is over 0."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_none_negative("a", a)
    _check_none_negative("b", b)
    weight = np.zeros(len(a), np.result_type(a, b))
    some = a > 0
    weight[some] = a[some] ** 2 / (a[some] ** 2 + b[some] ** 2)
    return weight
