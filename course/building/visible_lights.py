"""Lights by radiance as surfaces that rays can see."""

from __future__ import annotations

import numpy as np

from course import shapes
from course.building.frame import Frame
from course.building.ranges import in_range, in_reach
from course.building.shutter import Shutter
from course.core.triangles import Mesh
from course.core.types import Floats64
from course.extras.surface import FullPart
from course.formats.yaml.description import RectangleLight, SphereLight, rgb
from course.formats.yaml.loading import Loaded

SEGMENTS = 128
"""Around a visible sphere light; it lies inside the true sphere by at most 3e-4 radii."""


def emitter_parts(
    loaded: Loaded, frame: Frame, shutter: Shutter, first_material: int
) -> tuple[list[FullPart], list[Floats64]]:
    """Meshes of the visible lights, and the radiance of the material that each of them gets.

    Materials are numbered from ``first_material``. SceneError where float32 can't carry a corner or the radiance.
    """
    parts: list[FullPart] = []
    emission: list[Floats64] = []
    for number, light in enumerate(loaded.description.lights):
        if not isinstance(light, RectangleLight | SphereLight) or light.radiance is None:
            continue
        if isinstance(light, RectangleLight) and not light.visible:
            continue
        mesh = _rectangle(light) if isinstance(light, RectangleLight) else _sphere(light)
        mesh = Mesh(mesh.vertices + shutter.start(light.motion), mesh.triangles)
        velocity = shutter.velocity(light.motion, frame)
        placed = frame.mesh(mesh)
        in_reach(placed.vertices, loaded, ("lights", number), "the light's far end")
        parts.append(FullPart(placed, first_material + len(emission), velocity))
        radiance = in_range(rgb(light.radiance), loaded, ("lights", number), "the light's radiance")
        emission.append(radiance.astype(np.float64))
    return parts, emission


def _rectangle(light: RectangleLight) -> Mesh:
    corner, u, v = (np.array(x) for x in (light.corner, light.edge_u, light.edge_v))
    vertices = np.stack((corner, corner + u, corner + u + v, corner + v))
    return Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]))


def _sphere(light: SphereLight) -> Mesh:
    ball = shapes.sphere(light.radius, SEGMENTS)
    return Mesh(ball.vertices + np.array(light.center), ball.triangles)
