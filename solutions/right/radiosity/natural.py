"""The formulas as they are written, one channel or one row after the other."""

import numpy as np


def hemicube_form_factors(k):
    """From the cells' centres, by meshgrid; results in Fortran's order."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    step = 2 / k
    centre = -1 + step * (np.arange(k) + 0.5)
    x, y = np.meshgrid(centre, centre)
    top = step * step / (np.pi * (x**2 + y**2 + 1) ** 2)
    x, z = np.meshgrid(centre, centre[centre > 0])
    side = z * step * step / (np.pi * (x**2 + z**2 + 1) ** 2)
    return np.asfortranarray(top, np.float32), np.asfortranarray(side, np.float32)


def gather(radiosity, emission, reflectance, form_factors):
    """Row by row of the matrix."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    dtype = np.result_type(radiosity, emission, reflectance, form_factors)
    after = np.zeros((patches, 3), dtype)
    for i in range(patches):
        arriving = (form_factors[i] * radiosity).sum(axis=1)
        after[i] = emission[:, i] + reflectance[:, i] * arriving
    return after.T


def shoot(radiosity, unshot, reflectance, areas, form_factors, shooter):
    """Receiver by receiver."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("unshot", unshot, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("areas", areas, (patches,))
    _check_shape("form_factors", form_factors, (patches,))
    if not 0 <= shooter < patches:
        raise ValueError(f"shooter must be from 0 to {patches - 1}, got {shooter}")
    dtype = np.result_type(radiosity, unshot, reflectance, areas, form_factors)
    b, left = np.array(radiosity, dtype), np.array(unshot, dtype)
    power = unshot[:, shooter] * areas[shooter]
    left[:, shooter] = 0
    for j in range(patches):
        more = reflectance[:, j] * power * form_factors[j] / areas[j]
        b[:, j] += more
        left[:, j] += more
    return b, left


def needs_split(patch_radiosity, threshold):
    """Compared without a quotient."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    difference = np.ptp(patch_radiosity, axis=1).max(axis=0)
    peak = patch_radiosity.max(axis=(0, 1))
    return (difference > 0) & (difference > threshold * peak)
