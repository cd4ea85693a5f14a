"""Blinn-Phong highlights, for surfaces that are neither diffuse nor mirrors."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32
from course.core.vectors import dot


def blinn_phong_highlight(
    to_light: Floats32, direction: Floats32, normal: Floats32, exponent: Floats32
) -> Floats32:
    """(n . h)^exponent, (k,), with the half vector h between the directions to the light and to the viewer.

    Parameters
    ----------
    to_light, direction : (3, k) float32, unit length, to the light and from the viewer
    normal : (3, k) float32, unit length
    exponent : (k,) or (1,) float32

    Notes
    -----
    J. Blinn, "Models of light reflection for computer synthesized pictures", 1977.
    """
    half = to_light - direction
    squared = dot(half, half)
    cosine = dot(half, normal)
    cosine /= np.sqrt(np.maximum(squared, np.float32(1e-12)))
    # NumPy's exp and log are ten times faster than `power`. Below the clamp the power is
    # negligible for exponents from 1 up; exponent 0 gives 1 for every cosine.
    np.clip(cosine, np.float32(1e-6), 1, out=cosine)
    np.log(cosine, out=cosine)
    cosine *= exponent
    return np.exp(cosine, out=cosine)
