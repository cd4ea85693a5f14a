"""A parallelogram as a light: its points have an intensity, or it is a Lambertian emitter with a radiance."""

from dataclasses import dataclass

from course.core.lights.sample import TO_A_POINT, TO_A_SURFACE, Light, Sample, Towards
from course.core.types import Floats32, Functions


@dataclass(frozen=True)
class RectangleLight(Light):
    """A parallelogram, sampled uniformly by area.

    Attributes
    ----------
    corner, edge_u, edge_v : (3,) float32
    normal : (3,) float32 unit, on the side that emits; None if the points have an intensity
    color : (3,) float32, intensity / pi, or radiance times area / pi
    two_sided : true if the back emits like the front
    visible : true if an emitter is also a surface of the scene
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
