"""Plain Python, one number at a time."""

import math

import numpy as np


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    top = np.empty((k, k), np.float32)
    side = np.empty((k // 2, k), np.float32)
    area = (2 / k) ** 2
    for j in range(k):
        y = (2 * j + 1) / k - 1
        for i in range(k):
            x = (2 * i + 1) / k - 1
            top[j, i] = area / (math.pi * (x * x + y * y + 1) ** 2)
        for i in range(k // 2):
            z = (2 * i + 1) / k
            side[i, j] = z * area / (math.pi * (y * y + z * z + 1) ** 2)
    return top, side


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    after = np.empty((3, patches), np.result_type(radiosity, emission, reflectance, form_factors))
    for c in range(3):
        for i in range(patches):
            arriving = 0.0
            for j in range(patches):
                arriving += float(form_factors[i, j]) * float(radiosity[c, j])
            after[c, i] = float(emission[c, i]) + float(reflectance[c, i]) * arriving
    return after


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
    after, left = radiosity.astype(dtype), unshot.astype(dtype)
    for c in range(3):
        power = float(unshot[c, shooter]) * float(areas[shooter])
        left[c, shooter] = 0
        for j in range(patches):
            more = float(reflectance[c, j]) * power * float(form_factors[j]) / float(areas[j])
            after[c, j] += more
            left[c, j] += more
    return after, left


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    _, points, n = shape
    result = np.zeros(n, bool)
    for m in range(n):
        difference, peak = 0.0, 0.0
        for c in range(3):
            values = [float(patch_radiosity[c, p, m]) for p in range(points)]
            difference = max(difference, max(values) - min(values))
            peak = max(peak, max(values))
        result[m] = peak > 0 and difference / peak > threshold
    return result
