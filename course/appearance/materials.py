"""Materials as a table: one row for each property, one column for each material of the scene.

The reflected radiance is Blinn-Phong over pi, so that ``color`` is the share of the light that a diffuse surface
returns, with the irradiance E = I cos / d^2:

    L = color (ambient La + diffuse E / pi) + specular (n . h)^exponent E / pi

A dielectric has no ambient and diffuse terms, unless the scene asks for them: what it doesn't reflect goes through it.
Its inside shows none of the terms.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.appearance.conductors import Conductors
from course.core.types import Floats32, Mask, Materials, Media


@dataclass(frozen=True)
class MaterialTable:
    """M materials.

    Attributes
    ----------
    ambient, diffuse, specular, mirror : (3, M) float32
        Factors of the terms; ambient and diffuse contain the colour.
    exponent : (M,) float32
    refraction_index : (M,) float32 against what lies around it, 0 where the material is opaque
    absorption : (3, M) float32 [1 / unit of the compiled scene]
    emission : (3, M) float32 [W/(m^2 sr)], of the surfaces of lights and of all that glows by itself
    conductors : the metals, None where there are none
    plain : (M,) which materials have highlights without the cosine in E, None where none has
    lamps : (M,) which are the surfaces of lights: they shine from their fronts alone, and shadow rays look for them;
        None where none is
    outside : (M,) the material around each dielectric, -1 for vacuum; None where all lie in vacuum
    """

    ambient: Floats32
    diffuse: Floats32
    specular: Floats32
    exponent: Floats32
    mirror: Floats32
    refraction_index: Floats32
    absorption: Floats32
    emission: Floats32
    conductors: Conductors | None = None
    plain: Mask | None = None
    lamps: Mask | None = None
    outside: Media | None = None

    @cached_property
    def shaded(self) -> Mask:
        """(M,) which materials light from point-like sources makes visible."""
        return np.asarray((self.diffuse.max(0) > 0) | (self.specular.max(0) > 0))

    @cached_property
    def shaded_sides(self) -> Mask:
        """(1 or 2, M) the same from the front, and from the back where that differs: the inside of glass shows none."""
        back = self.shaded & ~self.refracts
        sides = [self.shaded] if (back == self.shaded).all() else [self.shaded, back]
        return np.stack(sides)

    @cached_property
    def shining(self) -> Floats32:
        """(3, M) emission of the surfaces of lights, 0 elsewhere."""
        return np.zeros_like(self.emission) if self.lamps is None else self.emission * self.lamps

    @cached_property
    def glowing(self) -> Floats32:
        """(3, M) emission of all other surfaces, which they send out from both sides."""
        return self.emission - self.shining

    @cached_property
    def diffuses(self) -> Mask:
        """(M,) which materials have a diffuse term."""
        return np.asarray(self.diffuse.max(0) > 0)

    @cached_property
    def refracts(self) -> Mask:
        """(M,) which materials are dielectrics."""
        return np.asarray(self.refraction_index > 0)


class Lookup:
    """Gathers properties for hits; where all materials agree, a single column serves all hits.

    Attributes
    ----------
    rows : (3, M) or (M,) float32, the properties of M materials
    """

    def __init__(self, rows: Floats32) -> None:
        self.rows = np.ascontiguousarray(rows)
        self._same = bool((rows == rows[..., :1]).all())

    def __call__(self, material: Materials) -> Floats32:
        """(3, n) or (3, 1) for rows of three, (n,) or (1,) for single rows."""
        if self._same:
            return self.rows[..., :1]
        return self.rows.take(material, axis=-1)
