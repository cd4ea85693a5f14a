"""A parallelogram: made of point lights (by intensity) or a Lambertian emitter (by radiance)."""

from __future__ import annotations

from dataclasses import dataclass

from course.core.functions import Functions
from course.core.lights.sample import TO_A_POINT, TO_A_SURFACE, Sample, Towards
from course.core.types import Floats32


@dataclass(frozen=True)
class RectangleLight:
    """A parallelogram, sampled uniformly by area.

    Attributes
    ----------
    corner, edge_u, edge_v : (3,) float32
    normal : (3,) float32 unit, on the emitting side of a light by radiance; None for a light by intensity
    color : (3,) float32, I / pi, or radiance times area / pi
    two_sided : true if the back emits like the front
    visible : true if a light by radiance is also a surface
    """

    name: str
    corner: Floats32
    edge_u: Floats32
    edge_v: Floats32
    normal: Floats32 | None
    color: Floats32
    soft_shadows: Functions
    width: int = 2
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True

    @property
    def limit(self) -> float:
        """See ``Light``."""
        return TO_A_SURFACE if self.normal is not None and self.visible else TO_A_POINT

    def sample(self, points: Floats32, u: Floats32 | None, towards: Towards) -> Sample:
        """See ``Light``."""
        assert u is not None
        on_light = self.soft_shadows.point_on_rectangle(self.corner, self.edge_u, self.edge_v, u)
        return towards(on_light, points, self.normal, self.two_sided)
