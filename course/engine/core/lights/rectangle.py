"""A parallelogram as a light: its points have an intensity, or it is a Lambertian emitter with a radiance."""

from dataclasses import dataclass

from course.engine.core.lights.sample import FlatLight, Sample
from course.engine.core.types import Floats32, Floats64, Functions


@dataclass(frozen=True)
class RectangleLight(FlatLight):
    """A parallelogram, sampled uniformly by area; ``color`` is intensity / pi, or radiance times area / pi."""

    name: str
    corner: Floats32
    edge_u: Floats32
    edge_v: Floats32
    normal: Floats64 | None
    color: Floats32
    soft_shadows: Functions
    width: int = 2
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``."""
        assert u is not None
        return self.from_point(self.on_light(u), points, self.corner[:, None])

    def on_light(self, u: Floats32) -> Floats32:
        """Points (3, n) on the light."""
        edges = self.edge_u, self.edge_v
        on_light: Floats32 = self.soft_shadows.point_on_rectangle(self.corner, *edges, u)
        return on_light
