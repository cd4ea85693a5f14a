"""Photons leave the lights of a scene: where, in which direction, and with which power.

Points and spotlights shine at a target alone, such as the ball around all mirrors and glass, where they stand outside
of it; so do the sun and the environment. Lights that are no surface and have an extent are points spread over it, as
shadow rays see them.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.environment import Environment
from course.engine.core.hits import Hits
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import RAISED, Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats32, Functions, Mask
from course.engine.core.vectors import gather
from course.engine.terms.environments.sky import SkySampling
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.sampled import SampledSphereLight
from course.engine.terms.lights.spot_light import SpotLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.scattering.hemisphere import turned

WIDTH = 6
"""Numbers of a photon that leaves: two of its direction, and the others of its place and side."""

ONE = np.ones(3, np.float32)

EMITTERS = (
    *(PointLight, SpotLight, DirectionalLight, RectangleLight, SphereLight),
    *(SampledSphereLight, VisibleSphereLight, MeshLight),
)
"""Lights that photons leave. A light of another type isn't known, though it were derived of one of these."""

PI = np.float32(np.pi)
EVERYWHERE = -1.0
"""Cosine of the edge of a cone that is all directions."""

UP = np.array([0, 0, 1], np.float32)
FAR = np.float32(1e4)
"""From where a disk looks as if from infinity, in its radii."""


@dataclass(frozen=True)
class Daylight:
    """The environment as a lamp; ``sampling`` chooses directions as it does for surfaces."""

    environment: Environment
    sampling: SkySampling
    name: str = "the environment"
    velocity: None = None


Lamp = Light | Daylight
"""What photons leave."""


@dataclass(frozen=True)
class Target:
    """A ball around what photons are sent to; ``reach``: of a ball around the scene, from the same centre."""

    center: Floats32
    radius: float
    reach: float


def can_emit(light: Light) -> bool:
    """Whether it is known where photons leave a light."""
    return type(light) in EMITTERS


def functions_for(lights: tuple[Lamp, ...]) -> set[str]:
    """Names of the module's functions that ``leaving`` calls for some lights."""
    found = set()
    for light in lights:
        surface = isinstance(light, VisibleSphereLight | MeshLight) or getattr(
            light, "emitter", False
        )
        if isinstance(light, Daylight):
            found |= {"emit_cone", "emit_directional"}
        elif isinstance(light, DirectionalLight):
            found.add("emit_directional")
        elif surface or (isinstance(light, RectangleLight) and light.normal is not None):
            found |= {"emit_area"} | ({"emit_cone"} if hasattr(light, "radius") else set())
        else:
            found.add("emit_cone")
    return found


def leaving(
    light: Lamp, count: int, u: Floats32, photons: Functions, target: Target
) -> tuple[Floats32, Floats32, Floats32]:
    """Origins, directions and powers, (3, n) each, of some of a light's ``count`` photons.

    Parameters
    ----------
    u : (WIDTH, n) float32 in [0, 1)
    photons : functions of the module
    """
    if isinstance(light, Daylight):
        return _from_the_sky(light, count, u, photons, target)
    n, way, place = u.shape[1], u[:2], u[2:4]
    strength = PI * light.color
    origin: Floats32
    match light:
        case DirectionalLight():
            back = -light.to_light
            disk = target.center, np.float32(target.radius), count
            origin, power = photons.emit_directional(back, strength, *disk, way)
            origin = origin - back[:, None] * np.float32(target.reach)
            return origin, np.repeat(back[:, None], n, axis=1), power
        case PointLight():
            axis, edge = _aimed(light, target)
            direction, power = photons.emit_cone(axis, edge, strength, count, way)
            position = np.repeat(light.position[:, None], n, axis=1)
            # Its share there: a spotlight sends less to the side, a cell of a rectangle by its cosine.
            return position, direction, power * light.sample(position + direction, None).factor
        case RectangleLight(normal=None):
            origin = light.on_light(place)
        case RectangleLight():
            assert light.normal is not None
            sides = u[4] < (0.5 if light.two_sided else 1)
            front = np.where(sides, np.float32(1), np.float32(-1))
            normal = light.normal[:, None].astype(np.float32) * front
            area = float(np.linalg.norm(np.cross(light.edge_u, light.edge_v)))
            origin = light.on_light(place) + normal * (4 * RAISED)
            return _off(origin, normal, light, area, 1 + light.two_sided, count, way, photons)
        case VisibleSphereLight() | SphereLight(emitter=True):
            normal, _ = photons.emit_cone(UP, EVERYWHERE, strength, 1, place)
            origin = light.center[:, None] + normal * np.float32(light.radius)
            area = 4 * np.pi * light.radius**2
            return _off(origin, normal, light, area, 1, count, way, photons)
        case SphereLight():
            direction, power = photons.emit_cone(UP, EVERYWHERE, strength, count, way)
            # A disk that faces what it lights faces the way of the light.
            seen_from = light.center[:, None] + direction * (FAR * np.float32(light.radius))
            return light.on_light(light.center, seen_from, u[2 : 2 + light.width]), direction, power
        case MeshLight():
            return _off_mesh(light, count, u, photons)
        case _:
            raise TypeError(f"photons know no light {type(light).__name__}")
    direction, power = photons.emit_cone(UP, EVERYWHERE, strength, count, way)
    return origin, direction, power


def _from_the_sky(
    sky: Daylight, count: int, u: Floats32, photons: Functions, target: Target
) -> tuple[Floats32, Floats32, Floats32]:
    """Photons from infinitely far away, from directions that a surface would choose, which may be turned anyhow.

    ``SkySampling`` weighs radiance for the irradiance over pi of one normal. For each direction the mean over all
    normals of the cosine, 0 where they are turned away, is a quarter. So the mean of what is weighed is the radiance
    from everywhere over 4 pi, the solid angle that ``emit_cone`` counts.
    """
    normal, everywhere = photons.emit_cone(UP, EVERYWHERE, ONE, 1, u[4:6])
    toward, weight = sky.sampling.sample(normal, np.ascontiguousarray(u[:2]))
    radiance = sky.environment.radiance(toward)
    if weight is not None:
        radiance = radiance * np.maximum(weight, 0)
    disk = UP, ONE, np.zeros(3, np.float32), np.float32(target.radius), count
    start, area = photons.emit_directional(*disk, u[2:4])
    origin = target.center[:, None] + turned(-toward, *start)
    origin += toward * np.float32(target.reach)
    return origin, -toward, np.asarray(radiance * everywhere * area, np.float32)


def _aimed(light: PointLight, target: Target) -> tuple[Floats32, float]:
    """Axis and cosine of the edge of the cone in which photons leave a point."""
    own = (light.axis, float(np.cos(light.outer))) if isinstance(light, SpotLight) else None
    way = target.center - light.position
    distance = float(np.linalg.norm(way))
    if distance <= target.radius * (1 + 1e-3):
        return own or (UP, EVERYWHERE)
    edge = float(np.sqrt(1 - (target.radius / distance) ** 2))
    # All cones that are narrower than this are as good as rays.
    edge = min(edge, 1 - 1e-6)
    if own is not None and own[1] >= edge:
        return own[0], min(own[1], 1 - 1e-6)
    return (way / np.float32(distance)).astype(np.float32), edge


def _off(
    origin: Floats32,
    normal: Floats32,
    light: RectangleLight | VisibleSphereLight | SphereLight | MeshLight,
    area: float,
    sides: int,
    count: int,
    u: Floats32,
    photons: Functions,
) -> tuple[Floats32, Floats32, Floats32]:
    """Photons that leave points of a surface that shines from one side or from both."""
    radiance = (PI * light.color / np.float32(area)).astype(np.float32)
    normal = np.ascontiguousarray(normal, np.float32)
    direction, power = photons.emit_area(normal, radiance, sides * area, count, u)
    return origin, direction, power


def _off_mesh(
    light: MeshLight, count: int, u: Floats32, photons: Functions
) -> tuple[Floats32, Floats32, Floats32]:
    """Photons that leave triangles, each as often as it is large."""
    triangle = np.searchsorted(light.shares, u[2], side="right")
    # What is left of the number within its triangle's share is as uniform as it was.
    ends = np.concatenate(([0], light.shares.astype(np.float64), [1]))
    low, high = ends.take(triangle), ends.take(triangle + 1)
    across = np.clip((u[2] - low) / np.maximum(high - low, 1e-30), 0, 1).astype(np.float32)
    root = np.sqrt(across)
    plane, edges = gather(light.planes, triangle), gather(light.edges, triangle)
    side = np.where(u[4] < 0.5, np.float32(1), np.float32(-1))
    normal = plane[3:6] * side
    origin = plane[:3] + edges[:3] * (1 - root) + edges[3:6] * (root * u[3])
    origin += normal * plane[6]
    sizes = light.edges[:, :6].astype(np.float64)
    area = float(np.linalg.norm(np.cross(sizes[:, :3], sizes[:, 3:]), axis=1).sum() / 2)
    return _off(origin, normal, light, area, 2, count, u[:2], photons)


def matte(diffuses: Mask, refracts: Mask, hits: Hits) -> Mask:
    """Which hits (n,) keep photons and show them: those with a diffuse term, but not in the inside of glass."""
    found: Mask = diffuses.take(hits.material)
    return found & (hits.entering | ~refracts.take(hits.material))
