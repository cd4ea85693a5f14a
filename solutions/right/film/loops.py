"""Pixel by pixel, with Python's own numbers."""

import math

import numpy as np


def expose(radiance, stops):
    """Channel by channel."""
    _check_batch("radiance", radiance, 3)
    _check_number("stops", stops, math.isfinite(stops), "finite")
    factor = math.pow(2, stops)
    return np.array([[factor * float(x) for x in row] for row in radiance], radiance.dtype)


def luminance(rgb):
    """Pixel by pixel."""
    _check_batch("rgb", rgb, 3)
    found = [0.2126 * float(r) + 0.7152 * float(g) + 0.0722 * float(b) for r, g, b in rgb.T]
    return np.array(found, rgb.dtype)


def encode_srgb(linear):
    """Value by value."""
    _check_batch("linear", linear, 3)

    def curve(x):
        x = min(max(x, 0.0), 1.0)
        return 12.92 * x if x <= 0.0031308 else 1.055 * math.pow(x, 1 / 2.4) - 0.055

    return np.array([[curve(float(x)) for x in row] for row in linear], linear.dtype)


def quantize(encoded, u):
    """Value by value."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError("u must have the shape of encoded")
    found = np.zeros(encoded.shape, np.int64)
    for place in np.ndindex(encoded.shape):
        x = 255 * float(encoded[place])
        low = math.floor(x)
        found[place] = min(low + (float(u[place]) >= 1 - (x - low)), 255)
    return found
