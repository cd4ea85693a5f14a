"""Pictures that are or are likely to be black, told before they are rendered.

Where nothing shines a picture is black for certain. Else a few rays are sent from the eye, straight through the picture
and all around, from what they meet to the lamps, and, where light goes from wall to wall, on from there at random. If
none finds any light, the mistake shows in what they met: the eye or the lamps stand inside something solid, something
stands before the lamps, or what is seen and the lamps are turned away from each other. No function of a student is
called, and where the rays leave any doubt nothing is said.
"""

import math
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import get_args

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.accelerator import QueryStats, StaticAccelerator
from course.engine.core.camera import Camera
from course.engine.core.hits import Hits
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats, Floats32, Floats64, Indices, Mask
from course.engine.core.vectors import normalise
from course.engine.formats.yaml import description as d
from course.engine.loops.packets import packets_of
from course.engine.scene.building.light_power import power
from course.engine.scene.building.world import compile_camera
from course.engine.scene.scene import Scene
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.scattering.materials import FullMaterials
from course.engine.terms.world import FullWorld


def why_black(scene: Scene) -> str:
    """Say why every picture of a scene is black for want of light; empty where there is some."""
    world, lights = scene.compiled.world, scene.loaded.description.lights
    if world.lights or _shines(world).any() or world.environment is not None:
        return ""
    if not lights:
        kinds = ", ".join(str(kind.__struct_config__.tag) for kind in get_args(d.Light))
        return (
            "the picture will be black: the scene has no lights, and its environment is black; "
            f"known are {kinds}, such as {{type: ambient, radiance: 1}}"
        )
    reasons = dict(world.skipped_lights)
    for number, light in enumerate(lights):
        if isinstance(light, d.AmbientLight):
            dark = not power(light).any()
            reasons[f"light {number}"] = (
                "it has no power" if dark else "no material has an ambient term"
            )
    listed = [f"{name}: {reason}" for name, reason in list(reasons.items())[:3]]
    return (
        "the picture will be black: the environment is black, and no light shows anything "
        f"({'; '.join(listed)}{'; ...' if len(reasons) > 3 else ''})"
    )


GRID, FINE = 12, 96
"""Rays in each direction of the picture; the more where the fewer find no light."""

BOUNCES = 8
"""That are followed where light goes from wall to wall."""

EVEN = np.array([[0.8191725], [0.6710436], [0.5497005]])
"""Inverse powers of the root of x^4 = x + 1."""

MOST = 64
"""Lights and their cells of which each is looked for."""

FEW = 64
"""Triangles of a lamp that are looked at."""

FAR = np.float32(1e6)
"""Distance at which directional lights are placed, in the unit of the compiled scene."""

NEXT_TO = 0.99
"""Share of the way to a light up to which something shades it."""

LIKELY = "the picture is likely to be black: "

BESIDE = 0.3
"""Radians around the cone of a spot light, in which what lies between the rays may be lit."""

_AROUND = np.array(
    [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z],
    np.float32,
)
AROUND = np.ascontiguousarray((_AROUND / np.linalg.norm(_AROUND, axis=1)[:, None]).T, np.float32)
"""Directions all around, to the faces, edges and corners of a cube, (3, 26)."""


Met = Callable[[Floats32, Floats32], Hits]
"""What rays from origins (3, n) or (3, 1) in directions (3, n) meet."""


def warn_of_darkness(scene: Scene, path: Path, packets: bool = False) -> bool:
    """Warn, once, of a picture that will be or is likely to be black; ``path`` is what the scene is called.

    Returns whether it did.
    """
    reason = why_dark(scene, packets)
    if reason:
        warnings.warn(f"{path}: {reason}", CourseWarning, stacklevel=2)
    return bool(reason)


def why_dark(scene: Scene, packets: bool = False) -> str:
    """Say why a scene's picture is likely to be black; empty where it isn't, or nobody can tell from a few rays.

    ``packets``: whether rays are asked of the hierarchy of compiled loops, for those will render the picture
    """
    world = scene.compiled.world
    reason = why_black(scene)
    # What moves, and the student's hierarchy, would call the student's functions.
    if reason or not isinstance(world.surface.accelerator, StaticAccelerator):
        return reason
    film = scene.settings
    camera = compile_camera(scene.loaded, scene.compiled.frame, film.width, film.height)
    met = partial(_met, world, packets)
    for grid in (GRID, FINE):
        seen = met(*_seen(camera, film.width, film.height, grid))
        if seen.size == 0:
            # Between the objects around it a camera may look out at the sky.
            if world.environment is None and _sees_nothing(scene, camera, film.width, film.height):
                return (
                    "the picture will be black: no object is in front of the camera, and the environment is black; "
                    "turn camera.look_at"
                )
            return ""
        if (seen.size < grid * grid and world.environment is not None) or _reached(
            world, met, seen
        ):
            return ""
    around = met(camera.origin[:, None], AROUND)
    inside = _inside(scene, camera.origin[:, None], around, world.lights)
    if inside:
        return f"{LIKELY}the camera stands inside {inside}, and no light does; move camera.eye"
    turned_away = _turned_away(scene, seen) if world.lights else ""
    # Through a wide lens more is seen than by the middle of it.
    return (
        turned_away
        if world.lens is not None
        else _locked_in(scene, met) or turned_away or _hidden(world)
    )


def _met(world: FullWorld, packets: bool, origin: Floats32, direction: Floats32) -> Hits:
    accelerator = world.surface.accelerator
    assert isinstance(accelerator, StaticAccelerator)
    if packets and len(accelerator.triangles):
        found = packets_of(accelerator).few(origin, direction)
    else:
        found = accelerator.intersect(origin, direction, QueryStats())
    return world.surface.hits(found, direction)


def _seen(camera: Camera, width: int, height: int, grid: int) -> tuple[Floats32, Floats32]:
    """Origins and directions of rays through the centres of grid x grid parts of the picture."""
    steps = (np.arange(grid, dtype=np.float32) + np.float32(0.5)) / grid
    x, y = np.repeat(steps, grid) * np.float32(width), np.tile(steps, grid) * np.float32(height)
    return camera.rays(x.astype(np.float32), y.astype(np.float32), None, None)


def _sees_nothing(scene: Scene, camera: Camera, width: int, height: int) -> bool:
    """True if all objects lie outside the pyramid of the picture; rays alone may miss small objects."""
    surfaces = any(getattr(light, "radiance", None) for light in scene.loaded.description.lights)
    if surfaces or scene.compiled.world.lens is not None:
        return False
    x, y = np.array([[0, width, width, 0], [0, 0, height, height]], np.float32)
    edges = camera.directions(x, y).T.astype(np.float64)
    sides = np.cross(edges, np.roll(edges, -1, axis=0))
    sides *= np.sign(sides @ edges.sum(axis=0))[:, None]
    inwards = np.concatenate((sides, edges.sum(axis=0)[None]))
    for box in scene.compiled.bounds:
        corners = _corners(scene.compiled.frame.position(box))
        if not (inwards @ (corners - camera.origin[:, None]) < 0).all(axis=1).any():
            return False
    return True


def _reached(world: FullWorld, met: Met, hits: Hits) -> bool:
    """True if light may come to any of the hits, straight from a light or, in path tracing, over other surfaces."""
    for bounce in range(1 if world.paths is None else BOUNCES):
        if _may_show_light(world, hits) or len(world.lights) > MOST:
            return True
        shaded = np.flatnonzero(world.materials.shaded.take(hits.material))
        origin, ng = (x.take(shaded, axis=1) for x in (hits.near_origin, hits.ng))
        if not len(shaded):
            return False
        # Even in three dimensions (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018): importing
        # NumPy's generators takes longer than all of this.
        u = ((np.arange(len(shaded)) + bounce / BOUNCES) * EVEN) % 1
        if any(_lit(world, met, light, hits, shaded, u) for light in world.lights):
            return True
        if world.paths is not None and _emitter_seen(world, met, origin, u):
            return True
        turn, z = 2 * np.pi * u[0], 2 * u[1] - 1
        sine = np.sqrt(1 - z * z)
        hits = met(origin, _unit(ng + np.stack((sine * np.cos(turn), sine * np.sin(turn), z))))
        if hits.size < len(shaded) and world.sky is not None:
            return True
        if not hits.size:
            return False
    return False


def _unit(x: Floats) -> Floats32:
    """Vectors (3, n) of length 1; those of length 0 stay so."""
    unit = x.astype(np.float32)
    normalise(unit)
    return unit


def _lit(
    world: FullWorld, met: Met, light: Light, hits: Hits, shaded: Indices, u: Floats64
) -> bool:
    """True if any of the hits ``shaded`` may see some point of a light, chosen by numbers u (3, n)."""
    p, ns = (x.take(shaded, axis=1) for x in (hits.p, hits.ns))
    which = np.flatnonzero(_shines_at(light, p) & _faced(light, p, ns))
    points, u = _points(light), u[:, which]
    one, other = (points[:, (points.shape[1] * v).astype(np.intp)] for v in u[:2])
    return _sees(
        world, met, hits.near_origin.take(shaded[which], axis=1), one + u[2] * (other - one)
    )


def _emitter_seen(world: FullWorld, met: Met, origin: Floats32, u: Floats64) -> bool:
    """True if from any origin (3, n) a triangle is seen that emits, be it a light or not."""
    triangles = world.surface.triangles
    emitting = np.flatnonzero((world.materials.emission.max(axis=0) > 0).take(triangles.material))
    if not len(emitting):
        return False
    chosen = emitting[(len(emitting) * u[0]).astype(np.intp)]
    edges = triangles.edges[chosen].T
    return _sees(world, met, origin, triangles.planes[chosen, :3].T + (edges[:3] + edges[3:6]) / 3)


def _sees(world: FullWorld, met: Met, origin: Floats32, points: Floats64) -> bool:
    """True if nothing stands between any of n origins and its point, (3, n) each, but what emits or is next to it."""
    way = points - origin
    far = np.linalg.norm(way, axis=0)
    which = np.flatnonzero(far)
    hits = met(origin.take(which, axis=1), _unit(way.take(which, axis=1)))
    near = far[which] if hits.ray is None else far[which[hits.ray]]
    emits = (world.materials.emission.max(axis=0) > 0).take(hits.material)
    return hits.size < len(which) or bool((emits | (hits.t > NEXT_TO * near)).any())


def _shines(world: FullWorld) -> Mask:
    """Which materials are seen without a light: they emit, show ambient light, or have a radiance of their own."""
    m = world.materials
    shines: Mask = (m.emission.max(0) > 0) | ((m.ambient * world.ambient[:, None]).max(0) > 0)
    if isinstance(m, FullMaterials) and m.unlit is not None:
        shines |= m.unlit.max(0) > 0
    return shines


def _may_show_light(world: FullWorld, hits: Hits) -> bool:
    """True if any of the hits shines by itself, or mirrors or refracts the light of other places."""
    m = world.materials
    shows = _shines(world) | (m.mirror.max(0) > 0) | m.refracts
    return bool(shows.take(hits.material).any())


def _inside(scene: Scene, place: Floats32, around: Hits, lights: Sequence[Light] = ()) -> str:
    """The objects around a place (3, 1) whose material is met on all sides; empty if a light is in the box of one."""
    names = list(scene.loaded.description.materials)
    met = {names[number] for number in np.unique(around.material) if number < len(names)}
    found = []
    for number, thing in enumerate(scene.loaded.description.objects):
        low, high = scene.compiled.frame.position(scene.compiled.bounds[number])[:, :, None]

        def holds(points: Floats32, low: Floats64 = low, high: Floats64 = high) -> bool:
            return bool(((low <= points) & (points <= high)).all(axis=0).any())

        if thing.material not in met or not holds(place):
            continue
        if any(holds(_points(light)) for light in lights):
            return ""
        found.append(f"{thing.name or thing.__struct_config__.tag} (objects.{number})")
    return " and ".join(found) if around.size == AROUND.shape[1] else ""


def _locked_in(scene: Scene, met: Met) -> str:
    """Which light is inside something; empty if none is."""
    for light in scene.compiled.world.lights:
        points = _points(light)
        middle = points.mean(axis=1, keepdims=True)
        # From outside a lamp that is a surface itself.
        beyond = 1.01 * np.linalg.norm(points - middle, axis=0).max() * AROUND
        around = met((middle + beyond).astype(np.float32), AROUND)
        if inside := _inside(scene, middle, around):
            return (
                f"{LIKELY}{light.name} is inside {inside}, which lets no light out; move the light"
            )
    return ""


def _hidden(world: FullWorld) -> str:
    """Why no light comes to what is seen, though some of it is turned to the lights, if there are any."""
    if not world.lights and world.paths is None:
        if world.environment is not None:
            return (
                f"{LIKELY}the environment lights no surface; set environment.lights, or add a light"
            )
        return (
            f"{LIKELY}what emits light lights nothing else: add {{type: object, object: its name}} to lights,"
            " or set integrator.type to path"
        )
    names = ", ".join([light.name for light in world.lights][:3]) or "what emits light"
    return f"{LIKELY}all that is seen lies in shadow: something stands before {names}"


def _points(light: Light) -> Floats32:
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
    ways: Floats32 = _points(light)[:, :, None] - points[:, None]
    return ways


def _cone(light: Light) -> tuple[Floats32, float] | None:
    """Axis and outer angle of a spot light, whose class only scenes with one import; None of other lights."""
    return (light.axis, light.outer) if hasattr(light, "outer") else None  # type: ignore[attr-defined]


def _shines_at(light: Light, points: Floats32) -> Mask:
    """(n,) which points are in front of a light, or not far beside the cone of one."""
    if (cone := _cone(light)) is not None:
        axis, outer = cone
        way = points - _points(light)
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


def _faced(light: Light, points: Floats32, normals: Floats32) -> Mask:
    """(n,) which points with normals look towards a light."""
    return np.asarray(((_ways(light, points) * normals[:, None]).sum(axis=0) > 0).any(axis=0))


def _turned_away(scene: Scene, seen: Hits) -> str:
    """Why none of the lights lights any of the hits; empty if one would, were nothing in its way."""
    lights = scene.compiled.world.lights
    if not any(_shines_at(light, seen.p).any() for light in lights):
        names = [light.name for light in lights]
        ways = ["turn the direction of spots"] if any(_cone(light) for light in lights) else []
        if not all(_cone(light) for light in lights):
            ways.append("exchange edge_u and edge_v, or set two_sided")
        return (
            f"{LIKELY}nothing that is seen is in front of a light "
            f"({', '.join(names[:3])}{', ...' if len(names) > 3 else ''}): {', or '.join(ways)}"
        )
    if not any(
        (_shines_at(light, seen.p) & _faced(light, seen.p, seen.ns)).any() for light in lights
    ):
        return f"{LIKELY}all that is seen is turned away from the lights"
    return ""


def _corners(points: Floats64) -> Floats64:
    """The corners (3, 8) of the box around points (k, 3)."""
    ends = np.stack((points.min(axis=0), points.max(axis=0)), axis=1)
    return np.stack(np.meshgrid(*ends)).reshape(3, -1)
