"""Phong's highlights: (r . v)^p, for the direction to the light mirrored to r.

B. T. Phong, "Illumination for computer generated pictures", 1975.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Mask, Materials
from course.engine.core.vectors import dot
from course.engine.terms.scattering.highlight import power


@dataclass(frozen=True)
class PhongHighlights:
    """See ``Highlight``."""

    materials: Mask

    def factor(
        self,
        to_light: Floats32,
        direction: Floats32,
        normal: Floats32,
        exponent: Floats32,
        _material: Materials,
    ) -> Floats32:
        """See ``Highlight``."""
        facing = dot(normal, to_light)
        seen = -dot(normal, direction)
        mirrored = 2 * facing * seen + dot(to_light, direction)
        return power(np.asarray(mirrored, np.float32), exponent)

    def left(self, _to_light: Floats32, _direction: Floats32, _material: Materials) -> None:
        """All of the light."""
