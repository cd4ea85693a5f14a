"""Each cell from 4 x 4 points in it; everything else in single precision."""

import math

import numpy as np


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    n = 4 * k
    x = (np.arange(n) + 0.5) * 2 / n - 1
    z = x[n // 2 :, None]
    top = 4 / n**2 / np.pi / (1 + x**2 + x[:, None] ** 2) ** 2
    side = 4 / n**2 / np.pi * z / (1 + x**2 + z**2) ** 2
    top = top.reshape(k, 4, k, 4).sum(axis=(1, 3))
    side = side.reshape(k // 2, 4, k, 4).sum(axis=(1, 3))
    return top.astype(np.float32), side.astype(np.float32)


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    arriving = np.einsum("ij,cj->ci", form_factors, radiosity)
    return arriving * reflectance + emission


def shoot(radiosity, unshot, reflectance, areas, form_factors, shooter):
    """One shot."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("unshot", unshot, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("areas", areas, (patches,))
    _check_shape("form_factors", form_factors, (patches,))
    if not 0 <= shooter < patches:
        raise ValueError(f"shooter must be from 0 to {patches - 1}, got {shooter}")
    dtype = np.result_type(radiosity, unshot, reflectance, areas, form_factors)
    power = unshot[:, shooter] * areas[shooter]
    irradiance = power[:, None] * (form_factors / areas)
    change = (reflectance * irradiance).astype(dtype)
    after, left = radiosity + change, unshot + change
    left[:, shooter] -= unshot[:, shooter]
    left[:, shooter] = change[:, shooter]
    return after, left


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    low, high = patch_radiosity.min(axis=1), patch_radiosity.max(axis=1)
    peak = high.max(axis=0)
    share = np.divide((high - low).max(axis=0), peak, out=np.zeros_like(peak), where=peak > 0)
    return share > threshold
