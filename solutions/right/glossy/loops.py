"""Plain Python, one column at a time, in double precision."""

import numpy as np


def orthonormal_basis(w):
    """Cross products with the axis that w is farthest from."""
    _check_batch("w", w, 3)
    u, v = np.empty_like(w), np.empty_like(w)
    for i in range(w.shape[1]):
        u[:, i], v[:, i] = _basis_of(w[:, i].astype(float))
    return u, v


def _basis_of(w):
    helper = [0.0, 0.0, 0.0]
    helper[min(range(3), key=lambda k: abs(w[k]))] = 1.0
    u = _cross(helper, w)
    length = sum(x * x for x in u) ** 0.5
    u = [x / length for x in u]
    return u, _cross(w, u)


def _cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def _unit(v):
    length = float(np.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))
    return v / length if length > 1e-30 else None


def _each(direction, u, one):
    result = np.empty(direction.shape, np.result_type(direction, u))
    for i in range(direction.shape[1]):
        result[:, i] = one(direction[:, i].astype(float), u[:, i].astype(float))
    return result


def jitter_on_plane(direction, roughness, u):
    """The square's rows swapped and both mirrored."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("roughness", roughness)

    def one(d, numbers):
        if roughness == 0:
            return d
        a, b = _basis_of(d)
        x, y = roughness * (0.5 - numbers)
        return _unit(d + y * np.array(a) + x * np.array(b))

    return _each(direction, u, one)


def jitter_in_ball(direction, glossiness, u):
    """The last number for the height, the first for the radius."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 3, np.shape(direction)[1])
    if not 0 <= glossiness < 1:
        raise ValueError(f"glossiness must be >= 0 and < 1, got {glossiness}")

    def one(d, numbers):
        if glossiness == 0:
            return d
        r = (1 - numbers[0]) ** (1 / 3)
        cos = 2 * numbers[2] - 1
        sin = max(1 - cos * cos, 0) ** 0.5
        phi = 2 * np.pi * numbers[1]
        point = r * np.array([cos, sin * np.sin(phi), sin * np.cos(phi)])
        jittered = _unit(d + glossiness * point)
        return d if jittered is None else jittered

    return _each(direction, u, one)


def sample_phong_lobe(direction, exponent, u):
    """The second number for the angle, the first for the turn."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)

    def one(d, numbers):
        cos = numbers[1] ** (1 / (exponent + 1))
        sin = max(1 - cos * cos, 0) ** 0.5
        phi = -2 * np.pi * numbers[0]
        a, b = (np.array(x) for x in _basis_of(d))
        return _unit(sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * d)

    return _each(direction, u, one)


def keep_above(direction, normal):
    """Mirror one at a time."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])

    def one(d, n):
        dot = float(d @ n)
        return d - 2 * dot * n if dot < 0 else d

    return _each(direction, normal, one)
