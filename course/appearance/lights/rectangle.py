"""A parallelogram: a cloud of point lights (by intensity) or a Lambertian emitter (by radiance)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.appearance.lights.sample import TO_A_POINT, TO_A_SURFACE, Sample, towards
from course.core.types import Floats32

PointOnRectangle = Callable[[Floats32, Floats32, Floats32, Floats32], Floats32]


@dataclass(frozen=True)
class RectangleLight:
    """Sampled uniformly by area.

    Attributes
    ----------
    corner, edge_u, edge_v : (3,) float32
    normal : (3,) float32 unit, the emitting side of a light by radiance; None for one by intensity
    color : (3,) float32, I / pi, or radiance times area / pi
    point_on_rectangle : the function of the soft_shadows module
    two_sided : whether the side away from the normal shines like the other
    visible : whether a light by radiance is also a surface
    """

    name: str
    corner: Floats32
    edge_u: Floats32
    edge_v: Floats32
    normal: Floats32 | None
    color: Floats32
    point_on_rectangle: PointOnRectangle
    width: int = 2
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True

    @property
    def limit(self) -> float:
        """How far along ``to_light`` a blocker counts."""
        return TO_A_SURFACE if self.normal is not None and self.visible else TO_A_POINT

    def sample(self, points: Floats32, u: Floats32 | None, compiled: bool = False) -> Sample:
        """See ``course.appearance.lights``."""
        assert u is not None
        on_light = self.point_on_rectangle(self.corner, self.edge_u, self.edge_v, u)
        return towards(on_light, points, self.normal, self.two_sided, compiled)
