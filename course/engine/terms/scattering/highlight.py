"""What a highlight of another model than Blinn's answers; to add one, write a class with these two methods.

For unit vectors l to the light, v to the viewer and the normal n, irradiance E and the material's ``specular``, the
radiance of a highlight is ``factor`` times specular E / pi. E has the cosine n . l.
"""

from typing import Protocol

import numpy as np

from course.engine.core.types import Floats32, Mask, Materials

LEAST = np.float32(1e-6)
"""The least cosine that has a logarithm, or that anything is divided by."""


class Highlight(Protocol):
    """Highlights of some materials."""

    @property
    def materials(self) -> Mask:
        """(M,) bool, those that have it."""

    def factor(
        self,
        to_light: Floats32,
        direction: Floats32,
        normal: Floats32,
        exponent: Floats32,
        material: Materials,
    ) -> Floats32:
        """What multiplies specular E / pi at hits on its materials, (k,) float32.

        Parameters
        ----------
        to_light, direction, normal : (3, k) float32 of unit length: to the light (or (3, 1)), from the viewer, and the
            normal
        exponent : (k,) or (1,) float32
        material : (k,) numbers of the hits' materials
        """

    def left(self, to_light: Floats32, direction: Floats32, material: Materials) -> Floats32 | None:
        """Share (k,) of the light that is left to the diffuse term; None where that is all."""


def power(cosine: Floats32, exponent: Floats32) -> Floats32:
    """Cosines (k,) to a power, 0 of those below 0 but for the power 0."""
    found: Floats32 = np.exp(exponent * np.log(np.clip(cosine, LEAST, 1)))
    found *= (cosine > 0) | (exponent == 0)
    return found
