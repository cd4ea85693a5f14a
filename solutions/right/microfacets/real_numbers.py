"""Fresnel's equations in real numbers, channel by channel, and everything else column by column with vectors of two."""

import numpy as np


def fresnel_complex(cos, n, k):
    """By the real and the imaginary part of the root."""
    _check_arrays(cos=(cos, "N"), n=(n, 3), k=(k, 3))
    if (np.asarray([n, k]) < 0).any() or np.isnan([n, k]).any():
        raise ValueError("n and k must not be below 0")
    if (np.add(n, k) == 0).any():
        raise ValueError("n and k must not be 0 together")
    result = np.empty((3, len(cos)), cos.dtype)
    for channel in range(3):
        result[channel] = _one_channel(cos, float(n[channel]), float(k[channel]))
    return result


def _one_channel(cos, n, k):
    cos = np.minimum(np.maximum(cos.astype(np.float64), 1e-18), 1)
    cos2 = cos * cos
    sin2 = (1 - cos) * (1 + cos)
    difference = (n - k) * (n + k) - sin2
    modulus = np.hypot(difference, 2 * n * k)
    p = np.sqrt(np.maximum(modulus + difference, 0) / 2)
    s = ((cos - p) ** 2 + np.maximum(modulus - difference, 0) / 2) / (
        (cos + p) ** 2 + np.maximum(modulus - difference, 0) / 2
    )
    above = cos2 * modulus + sin2 * sin2 - 2 * cos * p * sin2
    below = cos2 * modulus + sin2 * sin2 + 2 * cos * p * sin2
    ratio = np.where(below > 0, above / np.where(below > 0, below, 1), 1)
    return 0.5 * s * (1 + ratio)


def ggx(cos, alpha):
    """As a power of the whole."""
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    c = cos.astype(np.longdouble)
    whole = (alpha / (1 - c * c * (1 - np.longdouble(alpha) ** 2))) ** 2 / np.pi
    whole[c <= 0] = 0
    return whole.astype(cos.dtype)


def smith_g1(cos, alpha):
    """By the sine."""
    _check_alpha(alpha)
    _check_arrays(cos=(cos, "N"))
    result = np.zeros(len(cos))
    seen = cos > 0
    c = cos[seen].astype(np.float64)
    result[seen] = 2 / (1 + np.sqrt(1 + (alpha / c) ** 2 * (1 - c * c)))
    return result.astype(cos.dtype)


def smith_g2(cos_o, cos_i, alpha):
    """By 1 / G1."""
    _check_alpha(alpha)
    _check_arrays(cos_o=(cos_o, "N"), cos_i=(cos_i, "N"))
    result = np.zeros(len(cos_o))
    seen = (cos_o > 0) & (cos_i > 0)
    some = [1 / smith_g1(c[seen].astype(np.float64), alpha) for c in (cos_o, cos_i)]
    result[seen] = 1 / (some[0] + some[1] - 1)
    return result.astype(np.result_type(cos_o, cos_i))


def sample_visible_normal(wo, alpha, u):
    """Heitz's way, in the plane of view and normal, and turned to the view at the end."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), u=(u, 2, "N"))
    x, y, z = np.asarray(wo, np.float64)
    u1, u2 = np.asarray(u, np.float64)
    flat = np.hypot(x, y)
    heading = np.where(flat > 0, (x + 1j * y) / np.where(flat > 0, flat, 1), 1)
    length = np.hypot(alpha * flat, z)
    sine, cosine = alpha * flat / length, z / length
    place = np.sqrt(u1) * np.exp(2j * np.pi * u2)
    left = place.real
    half = np.sqrt(np.maximum(1 - left**2, 0))
    up = place.imag + (1 - cosine) / 2 * (half - place.imag)
    out = np.sqrt(np.maximum(half**2 - up**2, 0))
    forward = out * sine - up * cosine
    height = np.maximum(out * cosine + up * sine, 1e-12)
    slope = alpha * (forward + 1j * left) * heading
    size = np.sqrt(np.abs(slope) ** 2 + height**2)
    found = np.stack((slope.real, slope.imag, height)) / size
    return found.astype(np.result_type(wo, u))


def visible_normal_pdf(wo, wm, alpha):
    """Masking over the cosine, in one formula."""
    _check_alpha(alpha)
    _check_arrays(wo=(wo, 3, "N"), wm=(wm, 3, "N"))
    z = np.asarray(wo[2], np.float64)
    root = np.sqrt(alpha**2 + (1 - alpha**2) * z**2)
    turned = sum(a.astype(np.float64) * b for a, b in zip(wo, wm, strict=True))
    turned[turned < 0] = 0
    found = 2 * turned / (z + root) * ggx(np.asarray(wm[2], np.float64), alpha)
    return found.astype(np.result_type(wo, wm))
