"""Numbers that many pixels estimate independently, and the closed form that several tests hold them against.

A picture through a very small field of view sees one point. The mean of its 256 pixels is within 5 of its standard
errors with a false-fail rate of 1e-6 (Student's t for 255 degrees of freedom).
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course import Scene, render

Array = NDArray[np.float64]


def estimate(scene: Scene, samples: int = 64, **options: Any) -> tuple[Array, Array]:
    """Radiance (3,) and 5 of its standard errors."""
    pixels = render(scene, spp=samples, **options).linear.astype(np.float64).reshape(-1, 3)
    return pixels.mean(axis=0), 5 * pixels.std(axis=0, ddof=1) / math.sqrt(len(pixels))


def fresnel(cos_i: Any, eta: float) -> tuple[Array, Array]:
    """Unpolarised reflectance and the cosine of refraction, eta = n_from / n_to, written as in Hecht 4.6."""
    sin_t = eta * np.sqrt(1 - np.square(cos_i))
    cos_t = np.sqrt(np.maximum(1 - sin_t**2, 0))
    perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return np.where(sin_t >= 1, 1.0, (perpendicular**2 + parallel**2) / 2), cos_t
