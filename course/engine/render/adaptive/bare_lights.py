"""Lights that no ray meets, as things of which rough metals show highlights: where they are, and how bright."""

from collections.abc import Iterator

import numpy as np

from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats64
from course.engine.render.adaptive.bright import Bright
from course.engine.terms.world import FullWorld

NO_PART = -1

POINT = 1e-6
"""Radius of a point light here [unit of the compiled scene]: less than any lobe shows."""

FAR = 1e4
"""Distance of a directional light here [unit of the compiled scene]."""


def bare_lights(world: FullWorld) -> Iterator[tuple[Bright, Floats64]]:
    """Those that metals show, as disks that face all that they light; each with its middle (3, 1)."""
    for light in world.combining.bare if world.combining is not None else ():
        radius, far = POINT, 1.0
        match light:
            case DirectionalLight():
                place, far, radius = light.to_light * FAR, FAR, POINT * FAR
            case SphereLight():
                place, radius = light.center, light.radius
            case RectangleLight():
                place = light.corner + (light.edge_u + light.edge_v) / 2
                sides = light.edge_u.astype(np.float64), light.edge_v.astype(np.float64)
                radius = float(np.sqrt(np.linalg.norm(np.cross(*sides)) / np.pi))
            case PointLight():
                place = light.position
            case _:
                continue
        area = radius * radius * np.pi
        radiance = np.pi * light.color.astype(np.float64) * far**2 / area
        velocity = np.zeros(3) if light.velocity is None else light.velocity.astype(np.float64)
        none = np.empty(0, np.intp), np.empty(0)
        square = float((radiance**2).mean())
        thing = Bright(NO_PART, NO_PART, square, *none, area, velocity, fronts=False, closed=False)
        yield thing, place.astype(np.float64)[:, None]
