"""Metals: how much a smooth surface mirrors whose index of refraction is complex.

Symbols: n the real and k the imaginary part of the index, cos_i = -d . normal.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Mask, Materials


@dataclass(frozen=True)
class Conductors:
    """The metals among M materials.

    Attributes
    ----------
    metal : (M,) which materials are metals
    n, k : (3, M) float32, of no meaning where a material is none
    approximate : (M,) which metals have the approximate reflectance; None where none has
    """

    metal: Mask
    n: Floats32
    k: Floats32
    approximate: Mask | None = None

    def weakened(self, mirror: Floats32, material: Materials, cos_i: Floats32) -> Floats32:
        """The mirror's reflectance at hits, that of metals times their Fresnel reflectance.

        Parameters
        ----------
        mirror : (3, N) or (3, 1) float32
        material : (N,)
        cos_i : (N,) float32

        Returns
        -------
        (3, N) float32, or ``mirror`` itself where no hit is on a metal
        """
        which = np.flatnonzero(self.metal.take(material))
        if len(which) == 0:
            return mirror
        number = material.take(which)
        result = np.array(np.broadcast_to(mirror, (3, len(material))))
        arrays = cos_i.take(which), self.n.take(number, axis=1), self.k.take(number, axis=1)
        share = conductor_reflectance(*arrays)
        if self.approximate is not None:
            share = np.where(self.approximate.take(number), approximate_reflectance(*arrays), share)
        result[:, which] *= share
        return result


def approximate_reflectance(cos_i: Floats32, n: Floats32, k: Floats32) -> Floats32:
    """Unpolarised reflectance of a metal whose n^2 + k^2 is much larger than 1, so that light in it goes straight down.

    Parameters
    ----------
    cos_i : (N,) floating in [0, 1]
    n, k : (3, N) floating, not negative

    Returns
    -------
    (3, N) in [0, 1], 1 at grazing incidence

    Notes
    -----
    The mean of |(cos - n - i k) / (cos + n + i k)|^2 and the same with 1 / cos in place of cos. M. Pharr, G. Humphreys,
    "Physically based rendering", 2004, 9.2.
    """
    cos_i = np.minimum(np.maximum(cos_i, 0), 1)
    squares, twice = n * n + k * k, 2 * n * cos_i
    across, within = squares + cos_i * cos_i, squares * cos_i * cos_i + 1
    # If index and cosine are 0, the divisor is 0, too, and all light is mirrored.
    s = np.where(across > 0, (across - twice) / np.maximum(across + twice, np.float32(1e-30)), 1)
    result: Floats32 = np.clip((s + (within - twice) / (within + twice)) / 2, 0, 1)
    return result


def conductor_reflectance(cos_i: Floats32, n: Floats32, k: Floats32) -> Floats32:
    """Exact unpolarised reflectance of a metal, seen from vacuum.

    Parameters
    ----------
    cos_i : (N,) floating in [0, 1]
    n, k : (3, N) floating, not negative

    Returns
    -------
    (3, N) in [0, 1], 1 at grazing incidence

    Notes
    -----
    With p + i q = sqrt((n + i k)^2 - sin^2): s = (cos - p - i q) / (cos + p + i q), and the other polarisation is s
    times (p + i q - sin^2 / cos) / (p + i q + sin^2 / cos). M. Born, E. Wolf, "Principles of optics", 14.2.
    """
    # A normal turned to the viewer may leave it a rounding error outside.
    cos_i = np.minimum(np.maximum(cos_i, 0), 1)
    sin2 = (1 - cos_i) * (1 + cos_i)
    # By the cosine: next to it the 1 would hide what is left at grazing incidence.
    real = ((n - k) * (n + k) - 1) + cos_i * cos_i
    modulus = np.hypot(real, 2 * n * k)
    # The larger of p^2 and q^2 by a sum, and the smaller from their product (n k)^2: a difference would lose it.
    large2 = (modulus + np.abs(real)) / 2
    small = n * k / np.sqrt(np.maximum(large2, np.float32(1e-30)))
    p = np.where(real >= 0, np.sqrt(large2), small)
    even, odd = modulus + cos_i * cos_i, 2 * p * cos_i
    s = (even - odd) / np.maximum(even + odd, np.float32(1e-30))
    even2, odd2 = modulus * cos_i * cos_i + sin2 * sin2, odd * sin2
    other = (even2 - odd2) / np.maximum(even2 + odd2, np.float32(1e-30))
    result: Floats32 = np.clip(s * (1 + other) / 2, 0, 1)
    return result
