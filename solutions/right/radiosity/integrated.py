"""Form factors integrated exactly over the cells; matrices in double precision."""

import math

import numpy as np


def hemicube_form_factors(k):
    """Delta form factors."""
    if not (k >= 2 and k % 2 == 0):
        raise ValueError(f"k must be even and >= 2, got {k}")
    x = np.linspace(-1, 1, k + 1)
    y = x[:, None]
    r, q = np.sqrt(1 + x * x), np.sqrt(1 + y * y)
    over = (x / r * np.arctan(y / r) + y / q * np.arctan(x / q)) / (2 * np.pi)
    z = x[k // 2 :, None]
    s = np.sqrt(1 + z * z)
    beside = (np.arctan(x) - np.arctan(x / s) / s) / (2 * np.pi)
    top, side = (np.diff(np.diff(f, axis=0), axis=1).astype(np.float32) for f in (over, beside))
    return top, side


def gather(radiosity, emission, reflectance, form_factors):
    """One iteration."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("emission", emission, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("form_factors", form_factors, (patches, patches))
    dtype = np.result_type(radiosity, emission, reflectance, form_factors)
    b, e, rho, f = (x.astype(np.float64) for x in (radiosity, emission, reflectance, form_factors))
    return np.stack([e[c] + (rho[c][:, None] * f) @ b[c] for c in range(3)]).astype(dtype)


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
    b, u, rho, a, f = (
        x.astype(np.float64) for x in (radiosity, unshot, reflectance, areas, form_factors)
    )
    # By reciprocity: the share of what leaves a receiver that would reach the shooter.
    back = f * a[shooter] / a
    arrived = np.outer(u[:, shooter], back) * rho
    kept = np.where(np.arange(patches) == shooter, 0, u)
    return (b + arrived).astype(dtype), (kept + arrived).astype(dtype)


def needs_split(patch_radiosity, threshold):
    """Patches to divide."""
    shape = np.shape(patch_radiosity)
    if len(shape) != 3 or shape[0] != 3 or shape[1] < 1:
        raise ValueError(f"patch_radiosity must have shape (3, K, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    largest = patch_radiosity.max(axis=(0, 1))
    contrast = np.ptp(patch_radiosity, axis=1).max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return contrast / largest > threshold
