"""An object that emits light: any triangles, a point on one of them for each sample.

A group of triangles is chosen that sends much to the shaded point (``mesh_groups``), then one of its triangles with a
probability proportional to its area, and then a point on that (Turk, "Generating random points in triangles", Graphics
Gems, 1990). So points are uniform over each group. As the emission of a material is, its light is sent out from both
sides.
"""

from dataclasses import dataclass, field

import numpy as np

from course.engine.core.lights.sample import TO_A_POINT, Light, Sample, inverse_square
from course.engine.core.types import Floats32, Floats64
from course.engine.core.vectors import cross, dot, gather
from course.engine.terms.lights.mesh_groups import TriangleGroups, make_groups


@dataclass(frozen=True)
class MeshLight(Light):
    """T triangles as rays hit them.

    Attributes
    ----------
    shares : (T - 1,) float32, of the area: all up to each triangle but the last, which has the rest
    planes, edges : (T, 8) float32, see ``course.engine.core.triangles``
    color : (3,) float32, radiance times area / pi
    groups : the triangles in groups, made of the others
    """

    name: str
    shares: Floats32
    planes: Floats32
    edges: Floats32
    color: Floats32
    width: int = 3
    velocity: Floats32 | None = None
    limit: float = TO_A_POINT
    groups: TriangleGroups = field(init=False, repr=False)

    def __post_init__(self) -> None:
        # Not for the first sample: every thread that takes one then would make them, each its own.
        groups = make_groups(self.shares, self.planes, self.edges)
        object.__setattr__(self, "groups", groups)

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``.

        A shadow ray ends as far above the triangle as others start, not at a share of its way: of a thin box it would
        see both sides. From a point as near to the triangle's plane as that nothing arrives: it lies on it.
        """
        assert u is not None
        place, weight = self.groups.choose(points, u[0])
        found = np.searchsorted(self.groups.shares, place, side="right")
        triangle = self.groups.triangle.take(found)
        root = np.sqrt(u[1])
        plane, edges = gather(self.planes, triangle), gather(self.edges, triangle)
        to_light, normal, offset = plane[:3], plane[3:6], plane[6]
        to_light -= points
        to_light += edges[:3] * (1 - root)
        to_light += edges[3:6] * (root * u[2])
        height = dot(normal, to_light)
        normal *= np.copysign(offset, height)
        to_light -= normal
        inverse_length, factor = inverse_square(to_light)
        cosine = np.abs(height) * inverse_length
        # The end of the way is nearer than the triangle: at most by offset.
        np.minimum(cosine, 1, out=cosine)
        cosine *= np.abs(height) > 2 * offset
        factor *= cosine
        factor *= weight
        return Sample(to_light, inverse_length, factor)


def areas(edges: Floats32) -> Floats64:
    """Areas (T,) of triangles with edges (T, 8), see ``MeshLight``."""
    sides = edges[:, :6].astype(np.float64).T
    normal = cross(sides[:3], sides[3:])
    twice: Floats64 = np.sqrt(dot(normal, normal))
    return twice / 2


def shares(area: Floats64) -> Floats32:
    """``shares`` (T - 1,) of a ``MeshLight`` of triangles with areas (T,).

    In float32, as the numbers are that they are compared with: a triangle with a share of less than 2^-24 may be chosen
    more often or never.
    """
    sums = np.cumsum(area)
    shared: Floats32 = (sums[:-1] / sums[-1]).astype(np.float32)
    return shared
