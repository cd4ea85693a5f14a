"""Where lamps are, as a few points, and which of them shine at what."""

import math

import numpy as np

from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats32, Mask
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight

FEW = 64
"""Triangles of a lamp that are looked at."""

FAR = np.float32(1e6)
"""Distance at which directional lights are placed, in the unit of the compiled scene."""

BESIDE = 0.3
"""Radians around the cone of a spot light, in which what lies between the rays may be lit."""

_AROUND = np.array(
    [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z],
    np.float32,
)
AROUND = np.ascontiguousarray((_AROUND / np.linalg.norm(_AROUND, axis=1)[:, None]).T, np.float32)
"""Directions all around, to the faces, edges and corners of a cube, (3, 26)."""


def is_known(light: Light) -> bool:
    """Whether it is said here where a light is; of a scene with another, nothing is told."""
    kinds = PointLight | RectangleLight | MeshLight | DirectionalLight | SphereLight
    return isinstance(light, kinds | VisibleSphereLight)


def points_of(light: Light) -> Floats32:
    """Points (3, k) that span a light."""
    if isinstance(light, PointLight):
        return light.position[:, None]
    if isinstance(light, RectangleLight):
        corners = [
            light.corner + u * light.edge_u + v * light.edge_v for u in (0, 1) for v in (0, 1)
        ]
        return np.stack(corners, axis=1)
    if isinstance(light, MeshLight):
        return np.ascontiguousarray(light.planes[:: -(-len(light.planes) // FEW), :3].T)
    if isinstance(light, DirectionalLight):
        return FAR * light.to_light[:, None]
    assert isinstance(light, SphereLight | VisibleSphereLight)
    return light.center[:, None] + np.float32(light.radius) * AROUND


def _ways(light: Light, points: Floats32) -> Floats32:
    """(3, k, n) from n points to k of a light."""
    ways: Floats32 = points_of(light)[:, :, None] - points[:, None]
    return ways


def cone_of(light: Light) -> tuple[Floats32, float] | None:
    """Axis and outer angle of the cone that a light says it lights, ``lit_cone``; None if it says none."""
    return getattr(light, "lit_cone", None)


def shines_at(light: Light, points: Floats32) -> Mask:
    """(n,) which points are in front of a light, or not far beside the cone of one."""
    if (cone := cone_of(light)) is not None:
        axis, outer = cone
        way = points - points_of(light)
        far = np.sqrt((way * way).sum(axis=0))
        wide = math.cos(min(outer + BESIDE, math.pi))
        return np.asarray(axis @ way > far * np.float32(wide))
    if (
        not isinstance(light, PointLight | RectangleLight)
        or light.normal is None
        or light.two_sided
    ):
        return np.ones(points.shape[1], np.bool_)
    return np.asarray((np.tensordot(light.normal, _ways(light, points), 1) < 0).any(axis=0))


def faces(light: Light, points: Floats32, normals: Floats32) -> Mask:
    """(n,) which points with normals look towards a light."""
    return np.asarray(((_ways(light, points) * normals[:, None]).sum(axis=0) > 0).any(axis=0))
