"""Highlights by other models than Blinn's with the cosine: without it, Phong's, and those of microfacets.

For unit vectors l to the light, v to the viewer and the normal n, half vector h, exponent p and irradiance E, what
multiplies specular E / pi is

- Blinn's (n . h)^p, and Phong's (r . v)^p for l mirrored to r (B. T. Phong, "Illumination for computer generated
  pictures", 1975); without the cosine both over n . l;
- of microfacets, pi D F G / (4 (n . l) (n . v)), with D = (p + 2) / (2 pi) (n . h)^p, F by Schlick's approximation and
  G = min(1, 2 (n . h) min(n . l, n . v) / (h . v)) (K. Torrance and E. Sparrow, 1967; D by J. Blinn, 1977).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.engine.core.types import Floats32, Mask, Materials
from course.engine.core.vectors import dot

LEAST = np.float32(1e-6)
"""The least cosine that has a logarithm, or that anything is divided by."""


@dataclass(frozen=True)
class Highlights:
    """M materials; those of none of these kinds have Blinn's highlight with the cosine.

    Attributes
    ----------
    plain : (M,) bool, highlights that lack the cosine in E
    mirrored : (M,) bool, highlights by Phong
    facets : (M,) bool, highlights of microfacets
    straight : (M,) float32, reflectance of facets that light meets straight on
    covers : (M,) bool, materials whose diffuse term gets what facets leave; None if there are none
    """

    plain: Mask
    mirrored: Mask
    facets: Mask
    straight: Floats32
    covers: Mask | None

    @cached_property
    def others(self) -> Mask | None:
        """(M,) bool, materials whose highlights aren't Blinn's; None if there are none."""
        others = self.mirrored | self.facets
        return others if others.any() else None

    def factor(
        self,
        to_light: Floats32,
        direction: Floats32,
        normal: Floats32,
        exponent: Floats32,
        material: Materials,
    ) -> Floats32:
        """What multiplies the highlights (k,) of materials that are mirrored or have facets, with the cosine.

        Parameters
        ----------
        to_light, direction, normal : (3, k) of unit length: to the light (or (3, 1)), from the viewer, and the normal
        exponent : (k,) or (1,)
        """
        facing = dot(normal, to_light)
        seen = -dot(normal, direction)
        mirrored = 2 * facing * seen + dot(to_light, direction)
        half, met = _half(to_light, direction)
        upright = dot(half, normal)
        of_facets = self.facets.take(material)
        power = _power(np.where(of_facets, upright, mirrored), exponent)
        least = np.minimum(facing, seen)
        masked = np.minimum(1, 2 * upright * least / np.maximum(met, LEAST))
        masked /= np.maximum(facing, LEAST) * np.maximum(seen, LEAST)
        shine = (exponent + 2) / 8 * masked * self.fresnel(met, material) * (least > 0)
        return np.where(of_facets, power * shine, power).astype(np.float32)

    def left(self, to_light: Floats32, direction: Floats32, material: Materials) -> Floats32:
        """Share (k,) of light that the diffuse terms get; vectors as in ``factor``."""
        assert self.covers is not None
        share = 1 - self.fresnel(_half(to_light, direction)[1], material)
        return np.where(self.covers.take(material), share, np.float32(1)).astype(np.float32)

    def fresnel(self, cosine: Floats32, material: Materials) -> Floats32:
        """Reflectance (k,) of facets that light meets at a cosine."""
        straight = self.straight.take(material)
        reflectance: Floats32 = straight + (1 - straight) * (1 - np.clip(cosine, 0, 1)) ** 5
        return reflectance


def _half(to_light: Floats32, direction: Floats32) -> tuple[Floats32, Floats32]:
    """Half vectors (3, k), and their cosines (k,) to the viewer."""
    half = to_light - direction
    half /= np.sqrt(np.maximum(dot(half, half), np.float32(1e-12)))
    return half, -dot(half, direction)


def _power(cosine: Floats32, exponent: Floats32) -> Floats32:
    """Cosines to a power, 0 of those below 0 but for the power 0."""
    power: Floats32 = np.exp(exponent * np.log(np.clip(cosine, LEAST, 1)))
    power *= (cosine > 0) | (exponent == 0)
    return power
