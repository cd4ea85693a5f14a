"""Highlights of microfacets, over a diffuse term that may get what the facets leave.

With the half vector h, exponent p and E as in ``highlight.py``, the factor is pi D F G / (4 (n . l) (n . v)), with
D = (p + 2) / (2 pi) (n . h)^p, F by Schlick's approximation and G = min(1, 2 (n . h) min(n . l, n . v) / (h . v)).

K. Torrance and E. Sparrow, 1967; D by J. Blinn, 1977.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Mask, Materials
from course.engine.core.vectors import dot
from course.engine.terms.scattering.highlight import LEAST, power


@dataclass(frozen=True)
class FacetHighlights:
    """See ``Highlight``.

    Attributes
    ----------
    straight : (M,) float32, reflectance of facets that light meets straight on
    covers : (M,) bool, materials whose diffuse term gets what facets leave; None if there are none
    """

    materials: Mask
    straight: Floats32
    covers: Mask | None

    def factor(
        self,
        to_light: Floats32,
        direction: Floats32,
        normal: Floats32,
        exponent: Floats32,
        material: Materials,
    ) -> Floats32:
        """See ``Highlight``."""
        facing = dot(normal, to_light)
        seen = -dot(normal, direction)
        half, met = _half(to_light, direction)
        upright = dot(half, normal)
        least = np.minimum(facing, seen)
        masked = np.minimum(1, 2 * upright * least / np.maximum(met, LEAST))
        masked /= np.maximum(facing, LEAST) * np.maximum(seen, LEAST)
        shine = (exponent + 2) / 8 * masked * self._fresnel(met, material) * (least > 0)
        return (power(upright, exponent) * shine).astype(np.float32)

    def left(self, to_light: Floats32, direction: Floats32, material: Materials) -> Floats32 | None:
        """See ``Highlight``."""
        if self.covers is None:
            return None
        share = 1 - self._fresnel(_half(to_light, direction)[1], material)
        return np.where(self.covers.take(material), share, np.float32(1)).astype(np.float32)

    def _fresnel(self, cosine: Floats32, material: Materials) -> Floats32:
        """Reflectance (k,) of facets that light meets at a cosine."""
        straight = self.straight.take(material)
        reflectance: Floats32 = straight + (1 - straight) * (1 - np.clip(cosine, 0, 1)) ** 5
        return reflectance


def _half(to_light: Floats32, direction: Floats32) -> tuple[Floats32, Floats32]:
    """Half vectors (3, k), and their cosines (k,) to the viewer."""
    half = to_light - direction
    half /= np.sqrt(np.maximum(dot(half, half), np.float32(1e-12)))
    return half, -dot(half, direction)
