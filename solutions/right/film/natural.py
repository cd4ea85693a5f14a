"""As one writes it first: whatever dtype comes of it, and cast at the end; results in Fortran's order."""

import numpy as np


def expose(radiance, stops):
    """A factor."""
    _check_batch("radiance", radiance, 3)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return np.asfortranarray(np.ldexp(radiance, 0) * 2.0**stops, radiance.dtype)


def luminance(rgb):
    """A sum."""
    _check_batch("rgb", rgb, 3)
    red, green, blue = rgb
    return (0.2126 * red + 0.7152 * green + 0.0722 * blue).astype(rgb.dtype)


def photographic(radiance, key, burn, saturation):
    """Single precision where the picture has it."""
    _check_batch("radiance", radiance, 3)
    _check_number("key", key, 0 < key < np.inf, "finite and > 0")
    _check_number("burn", burn, 0 <= burn <= 100, "from 0 to 100")
    _check_number("saturation", saturation, 0 <= saturation < np.inf, "finite and >= 0")
    y = luminance(radiance)
    if not (y > 0).any():
        return 0 * radiance
    tone = key * y / np.exp(np.mean(np.log(y[y > 0]), dtype=float))
    white = np.percentile(tone, 100 - burn)
    if white == 0:
        return 0 * radiance
    display = tone * (1 + tone / white**2) / (1 + tone)
    ratio = np.divide(radiance, y, out=np.zeros_like(radiance), where=y > 0)
    return (display * ratio**saturation).astype(radiance.dtype)


def encode_srgb(linear):
    """A copy, changed in place."""
    _check_batch("linear", linear, 3)
    found = linear.clip(0, 1)
    dark = found <= 0.0031308
    found[dark] *= 12.92
    found[~dark] = 1.055 * found[~dark] ** (1 / 2.4) - 0.055
    return np.asfortranarray(found)


def quantize(encoded, u):
    """In single precision where they have it."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError("u must have the shape of encoded")
    return np.clip((255 * encoded + u).astype(int), 0, 255)


def convert_gamut(rgb, source, target):
    """One matrix, by einsum."""
    _check_batch("rgb", rgb, 3)
    for gamut in (source, target):
        if np.shape(gamut) != (2, 4):
            raise ValueError("source and target must have shape (2, 4)")
    basis = []
    for gamut in (source, target):
        xy = np.array(gamut, dtype=float)
        xyz = np.vstack([xy, 1 - xy.sum(axis=0)])
        lamps, white = xyz[:, :3], xyz[:, 3] / xyz[1, 3]
        basis.append(lamps * (np.linalg.inv(lamps) @ white))
    there = np.linalg.inv(basis[1]).dot(basis[0])
    return np.einsum("ij,jn->in", there.astype(rgb.dtype), rgb)
