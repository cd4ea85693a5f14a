"""Reflection and refraction at the smooth boundary of two clear media.

Symbols: n the normal on the incoming side, cos_i = -d . n, cos_t the cosine of the refracted ray,
eta = n_from / n_to. Snell's law: sin_t = eta sin_i. If sin_t > 1, there is total internal reflection.
"""

import numpy as np

from course.engine.core.types import Floats32


def fresnel_and_cos_t(cos_i: Floats32, eta: Floats32) -> tuple[Floats32, Floats32]:
    """Exact unpolarised Fresnel reflectance and cos_t, from cos_i in [0, 1] and eta; all (n,) float32.

    For total internal reflection the reflectance is exactly 1, and cos_t is 0.
    """
    # 1 - sin_t^2 loses digits at the critical angle; (1 - eta sin_i)(1 + eta sin_i) keeps them.
    sin_t = np.sqrt((1 - cos_i) * (1 + cos_i))
    sin_t *= eta
    squared = (1 - sin_t) * (1 + sin_t)
    total = squared <= 0
    cos_t = np.sqrt(np.maximum(squared, 0))
    # Amplitude ratios of both polarisations; numerators and denominators are divided by n_to. If both cosines are 0,
    # `total` sets the result to 1.
    s_sum, p_sum = eta * cos_i + cos_t, cos_i + eta * cos_t
    s = (eta * cos_i - cos_t) / np.maximum(s_sum, np.float32(1e-20))
    p = (cos_i - eta * cos_t) / np.maximum(p_sum, np.float32(1e-20))
    reflectance = (s * s + p * p) * np.float32(0.5)
    reflectance[total] = 1
    return np.minimum(reflectance, 1, out=reflectance), cos_t


def refract(
    direction: Floats32, normal: Floats32, cos_i: Floats32, cos_t: Floats32, eta: Floats32
) -> Floats32:
    """Refracted directions eta d + (eta cos_i - cos_t) n, (3, n) float32, unit length."""
    refracted: Floats32 = direction * eta
    refracted += normal * (eta * cos_i - cos_t)
    return refracted
