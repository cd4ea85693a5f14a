"""Materials as a table: one row per property, one column per material of the scene.

The BRDF is Blinn-Phong divided by pi, so that the diffuse reflectance is color * diffuse. With the irradiance
E = I cos / d^2:

    L = color (ambient La + diffuse E / pi) + specular (n . h)^exponent E / pi

A dielectric transmits what it doesn't reflect. A scene may give it ambient, diffuse and specular terms, too; they
apply to hits from outside only.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.engine.core.types import Floats32, Mask, Materials, Media


@dataclass(frozen=True)
class MaterialTable:
    """M materials.

    Attributes
    ----------
    ambient, diffuse, specular, mirror : (3, M) float32, factors of the terms; ambient and diffuse contain the colour
    exponent : (M,) float32
    refraction_index : (M,) float32, relative to the medium outside; 0 for opaque materials
    absorption : (3, M) float32 [1 / unit of the compiled scene]
    emission : (3, M) float32 [W/(m^2 sr)]
    lamps : (M,) bool, surfaces of lights; None if no light has a surface
    outside : (M,) material around each dielectric, -1 for vacuum; None if vacuum is around all
    """

    ambient: Floats32
    diffuse: Floats32
    specular: Floats32
    exponent: Floats32
    mirror: Floats32
    refraction_index: Floats32
    absorption: Floats32
    emission: Floats32
    lamps: Mask | None = None
    outside: Media | None = None

    @cached_property
    def shaded(self) -> Mask:
        """(M,) bool, materials with a diffuse or a specular term."""
        return np.asarray((self.diffuse.max(0) > 0) | (self.specular.max(0) > 0))

    @cached_property
    def shaded_sides(self) -> Mask:
        """(2, M) ``shaded`` of fronts and backs, which differ for dielectrics; (1, M) if they are the same."""
        back = self.shaded & ~self.refracts
        sides = [self.shaded] if (back == self.shaded).all() else [self.shaded, back]
        return np.stack(sides)

    @cached_property
    def diffuses(self) -> Mask:
        """(M,) bool, materials with a diffuse term."""
        return np.asarray(self.diffuse.max(0) > 0)

    @cached_property
    def refracts(self) -> Mask:
        """(M,) bool, the dielectrics."""
        return np.asarray(self.refraction_index > 0)


class Lookup:
    """A property of all materials, (3, M) or (M,) float32, from which hits gather theirs."""

    def __init__(self, rows: Floats32) -> None:
        self.rows = np.ascontiguousarray(rows)
        self._same = bool((rows == rows[..., :1]).all())

    def __call__(self, material: Materials) -> Floats32:
        """(3, n) from rows (3, M), (n,) from rows (M,); one column if all materials have the same value."""
        if self._same:
            return self.rows[..., :1]
        return self.rows.take(material, axis=-1)
