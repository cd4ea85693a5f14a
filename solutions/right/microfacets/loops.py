"""One column after the other, in Python's own numbers."""

import cmath
import math

import numpy as np


def _each(function, count, dtype, *columns, rows=0):
    out = np.zeros((rows, count) if rows else count, dtype)
    for number, column in enumerate(zip(*(c.T.tolist() for c in columns), strict=True)):
        out[..., number] = function(*column)
    return out


def _one_d(c, alpha):
    if c <= 0:
        return 0.0
    low = (1 - c) * (1 + c) + alpha * alpha * c * c
    return (alpha / low) ** 2 / math.pi


def _one_g(cosines, alpha):
    total = 1.0
    for c in cosines:
        if c <= 0:
            return 0.0
        tangent = math.sqrt(max((1 - c) * (1 + c), 0)) / c
        total += 0.5 * math.hypot(1, alpha * tangent) - 0.5
    return 1 / total


def _one_f(c, index):
    c = min(max(c, 1e-18), 1)
    inner = cmath.sqrt(1 - (1 - c * c) / index**2)
    s, p = (c - index * inner) / (c + index * inner), (inner - index * c) / (inner + index * c)
    return (abs(s) ** 2 + abs(p) ** 2) / 2


def ggx(cos, alpha):
    """One by one."""
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    return _each(lambda c: _one_d(c, alpha), len(cos), cos.dtype, cos)


def smith_g1(cos, alpha):
    """One by one."""
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    return _each(lambda c: _one_g([c], alpha), len(cos), cos.dtype, cos)


def smith_g2(cos_o, cos_i, alpha):
    """One by one."""
    _check_alpha(alpha)
    _check_arrays(cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    kind = np.result_type(cos_o, cos_i)
    return _each(lambda *c: _one_g(c, alpha), len(cos_o), kind, cos_o, cos_i)


def sample_visible_normal(wo, alpha, u):
    """The view mirrored in a cap of the sphere, one by one."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), u=(u, 2, "N"))

    def one(w, numbers):
        x, y, z = alpha * w[0], alpha * w[1], w[2]
        size = math.sqrt(x * x + y * y + z * z)
        x, y, z = x / size, y / size, z / size
        top = (1 - numbers[1]) * (1 + z) - z
        ring = math.sqrt(max(1 - top * top, 0))
        angle = math.tau * numbers[0]
        x, y, z = x + ring * math.cos(angle), y + ring * math.sin(angle), max(z + top, 1e-12)
        x, y = alpha * x, alpha * y
        size = math.sqrt(x * x + y * y + z * z)
        return x / size, y / size, z / size

    return _each(one, wo.shape[1], np.result_type(wo, u), wo, u, rows=3)


def visible_normal_pdf(wo, wm, alpha):
    """One by one."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wm=(wm, 3, "N"))

    def one(o, m):
        slant = max(o[0] * m[0] + o[1] * m[1] + o[2] * m[2], 0)
        return _one_g([o[2]], alpha) * slant * _one_d(m[2], alpha) / o[2]

    return _each(one, wo.shape[1], np.result_type(wo, wm), wo, wm)


def fresnel_complex(cos, n, k):
    """One by one."""
    _check_arrays(cos=(cos, "N"), n=(n, 3), k=(k, 3))
    index = [complex(a, b) for a, b in zip(n, k, strict=True)]
    for each in index:
        if not (each.real >= 0 and each.imag >= 0) or each == 0:
            raise ValueError("n and k must be >= 0, one of them above")
    return _each(lambda c: [_one_f(c, m) for m in index], len(cos), cos.dtype, cos, rows=3)


def brdf(wo, wi, alpha, n, k):
    """One by one."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wi=(wi, 3, "N"), n=(n, 3), k=(k, 3))
    index = [complex(a, b) for a, b in zip(n, k, strict=True)]

    def one(o, i):
        if o[2] <= 0 or i[2] <= 0:
            return [0.0] * 3
        middle = [a + b for a, b in zip(o, i, strict=True)]
        size = math.sqrt(sum(a * a for a in middle))
        slant = sum(a * b for a, b in zip(o, middle, strict=True)) / size
        value = _one_d(middle[2] / size, alpha) * _one_g([o[2], i[2]], alpha) / (4 * o[2] * i[2])
        return [value * _one_f(slant, m) for m in index]

    return _each(one, wo.shape[1], np.result_type(wo, wi), wo, wi, rows=3)
