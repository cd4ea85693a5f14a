"""From light descriptions to lights in the frame of the compiled scene, and to surfaces that rays can see."""

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from course.base.errors import CourseWarning, FunctionError
from course.engine import shapes
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.materials import MaterialTable
from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats32, Floats64, Functions
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame, in_range, in_reach
from course.engine.scene.building.light_power import given, why_dark
from course.engine.scene.building.motion import Shutter
from course.engine.scene.building.multiple_importance import asks_for_phong
from course.engine.scene.building.repeated import repeated
from course.engine.scene.building.sampled_points import NUMBERS, SPHERES
from course.engine.shapes.mesh import Mesh
from course.engine.terms.lights.light_choice import UNIFORM, LightChoice, PowerChoice
from course.engine.terms.lights.light_tree import functions_for, tree_choice
from course.engine.terms.lights.mesh_light import MeshLight, areas, shares
from course.engine.terms.lights.sampled import SampledSphereLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.surfaces.surface import FullPart


@dataclass(frozen=True)
class Lit:
    """Objects that are lights, as rays hit them.

    Attributes
    ----------
    triangles : of the whole scene
    materials : the number of the material that each light's object has for itself, by the number of the light
    """

    triangles: Triangles
    materials: dict[int, int]


def compile_lights(
    loaded: Loaded,
    frame: Frame,
    shutter: Shutter,
    bound: Bound,
    materials: MaterialTable,
    objects: Lit,
    lifts: Mapping[int, Floats64],
) -> tuple[tuple[Light, ...], dict[str, str]]:
    """Lights that light something, and name -> reason for those that don't.

    ``lifts`` : see ``course.engine.scene.building.coplanar``
    A light that is sampled as a grid becomes a point light for each cell.
    """
    scene = loaded.description
    by_lobes = asks_for_phong(scene.integrator) or any(
        material.conductor is not None and material.conductor.roughness
        for material in scene.materials.values()
    )
    lights: list[Light] = []
    skipped: dict[str, str] = {}
    for number, light in enumerate(scene.lights):
        name = f"light {number}"
        if isinstance(light, d.AmbientLight):
            continue
        reason = why_dark(light, materials, by_lobes, bool(scene.media))
        if reason:
            skipped[name] = reason
            continue
        known = name, ("lights", number), loaded, frame, shutter, bound
        compiler = _Compiler(*known, lifts.get(number, np.zeros(3)))
        if isinstance(light, d.ObjectLight):
            lights.append(compiler.of_object(light, objects.triangles, objects.materials[number]))
        else:
            lights += compiler(light)
    return tuple(lights), skipped


def compile_choice(loaded: Loaded, lights: Sequence[Light], bound: Bound) -> LightChoice | None:
    """What chooses one of the lights for each hit; None if all of them are asked."""
    asked = loaded.description.integrator.light_sampling
    # The cells of a grid are one light of the file.
    many = len({light.name for light in lights}) > d.MANY_LIGHTS
    if len(lights) < 2 or asked == "all" or (asked == "automatic" and not many):
        return None
    if asked != "tree":
        return PowerChoice(tuple(lights), uniform=1.0 if asked == "uniform" else UNIFORM)
    key = ("integrator", "light_sampling")
    functions = bound.functions("many_lights", *functions_for(lights), asked_by=key)
    try:
        return tree_choice(tuple(lights), functions)
    except FunctionError as error:
        # It is called before there is a render that would say so.
        raise error.asked_by(loaded.document.where(key), key) from error.__cause__


@dataclass(frozen=True)
class _Compiler:
    """Compiles one light; an intensity counts per squared length, so it shrinks with the scene's unit squared."""

    name: str
    path: tuple[str | int, ...]
    loaded: Loaded
    frame: Frame
    shutter: Shutter
    bound: Bound
    lift: Floats64

    def __call__(
        self, light: d.PointLight | d.DirectionalLight | d.RectangleLight | d.SphereLight
    ) -> list[Light]:
        match light:
            case d.SpotLight():
                axis = np.array(light.direction) / np.abs(light.direction).max()
                return [self._spot(light, axis / np.linalg.norm(axis))]
            case d.PointLight():
                power = rgb(light.intensity) / self.frame.scale / self.frame.scale
                position = self._position(light.position, light.motion)
                color = self._color(power)
                whole = light.shadow_rays == "whole"
                velocity = self._velocity(light)
                return [PointLight(self.name, position, color, velocity=velocity, blockable=whole)]
            case d.DirectionalLight():
                direction = np.array(light.direction) / np.abs(light.direction).max()
                towards = -direction / np.linalg.norm(direction)
                color = self._color(rgb(light.irradiance))
                return [DirectionalLight(self.name, _single(towards), color)]
            case d.RectangleLight():
                return self._rectangle(light)
            case d.SphereLight():
                return [self._sphere(light)]

    def _spot(self, light: d.SpotLight, axis: Floats64) -> Light:
        # Its module is loaded by scenes that have one alone.
        from course.engine.terms.lights.spot_light import SpotLight

        return SpotLight(
            self.name,
            self._position(light.position, light.motion),
            self._color(rgb(light.intensity) / self.frame.scale / self.frame.scale),
            velocity=self._velocity(light),
            blockable=light.shadow_rays == "whole",
            axis=_single(axis),
            inner=math.radians(light.inner_angle),
            outer=math.radians(light.outer_angle),
        )

    def of_object(self, light: d.ObjectLight, triangles: Triangles, material: int) -> MeshLight:
        """A light of the triangles that have a material."""
        which = np.flatnonzero(triangles.material == material)
        # Those without area shine nowhere.
        which = which[areas(triangles.edges[which]) > 0]
        again = repeated(triangles.planes[which], triangles.edges[which])
        if again.any():
            warnings.warn(
                f"{self.loaded.document.where(self.path)}: {again.sum():,} of {len(which):,} triangles of the object"
                f' "{light.object}" lie where others of it lie; each place shines once',
                CourseWarning,
                stacklevel=2,
            )
        which = which[~again]
        edges = triangles.edges[which]
        area = areas(edges)
        if not area.sum() > 0:
            raise self.loaded.document.error(
                (*self.path, "object"),
                f'the object "{light.object}" has no area to shine from: expected triangles with an area,'
                " in a scene that isn't 10^7 times as large",
            )
        scene = self.loaded.description
        thing = next(thing for thing in scene.objects if thing.name == light.object)
        radiance = rgb(scene.materials[thing.material].emission)
        return MeshLight(
            self.name,
            shares(area),
            triangles.planes[which],
            edges,
            self._color(radiance * area.sum()),
            velocity=self._velocity(thing),
        )

    def _rectangle(self, light: d.RectangleLight) -> list[Light]:
        edge_u, edge_v = self.frame.vector(light.edge_u), self.frame.vector(light.edge_v)
        in_reach(np.stack((edge_u, edge_v)), self.loaded, self.path, "the light's size")
        # From unit edges: the area of a tiny light may be 0 in float64, but its normal exists.
        unit_u, unit_v = (edge / np.abs(edge).max() for edge in (edge_u, edge_v))
        normal = np.cross(unit_u, unit_v)
        sine = float(np.linalg.norm(normal))
        area = float(np.abs(edge_u).max() * np.abs(edge_v).max()) * sine
        corner = self._position(light.corner, light.motion)
        facing = None if light.radiance is None else normal / sine
        power = self._power(light, area)
        velocity = self._velocity(light)
        if light.samples == "point":
            soft_shadows = self.bound.functions(
                "soft_shadows", "point_on_rectangle", asked_by=self.path
            )
            edges = _single(edge_u), _single(edge_v)
            color = self._color(power)
            return [
                RectangleLight(
                    self.name,
                    corner,
                    *edges,
                    facing,
                    color,
                    soft_shadows,
                    velocity=velocity,
                    two_sided=light.two_sided,
                    visible=light.visible,
                )
            ]
        k = grid_size(light.samples)
        soft_shadows = self.bound.functions("soft_shadows", "light_grid", asked_by=self.path)
        try:
            points = soft_shadows.light_grid(corner, _single(edge_u), _single(edge_v), k)
        except FunctionError as error:
            # It is called before there is a render that would say so.
            raise error.asked_by(
                self.loaded.document.where(self.path), self.path
            ) from error.__cause__
        color = self._color(power / (k * k))
        return [
            PointLight(
                self.name,
                _single(point),
                color,
                facing,
                velocity=velocity,
                two_sided=light.two_sided,
                visible=light.visible,
            )
            for point in points.T
        ]

    def _sphere(self, light: d.SphereLight) -> Light:
        radius = light.radius / self.frame.scale
        in_reach(np.array(radius), self.loaded, self.path, "the light's size")
        color = self._color(self._power(light, 4 * math.pi * radius * radius))
        center = self._position(light.center, light.motion)
        velocity = self._velocity(light)
        if np.float32(radius) == 0:
            return PointLight(self.name, center, color, velocity=velocity)
        if light.samples == "visible":
            return VisibleSphereLight(self.name, center, radius, color, velocity=velocity)
        module, function = SPHERES[light.samples]
        functions = self.bound.functions(module, function, asked_by=self.path)
        known = self.name, center, radius, light.radiance is not None, color, light.samples
        drawn = NUMBERS.get(light.samples, 2), velocity
        if module == "sampling":
            return SampledSphereLight(*known, Functions(), *drawn, functions)
        return SphereLight(*known, functions, *drawn)

    def _power(self, light: d.RectangleLight | d.SphereLight, area: float) -> Floats64:
        """Intensity in compiled units, or radiance times compiled area."""
        if light.radiance is not None:
            return rgb(light.radiance) * area
        return rgb(given(light.intensity)) / self.frame.scale / self.frame.scale

    def _color(self, power: Floats64) -> Floats32:
        unit = "in units of the scene's size"
        return in_range(power / math.pi, self.loaded, self.path, "the light's power", unit)

    def _position(self, x: d.Vector, motion: d.MotionDescription) -> Floats32:
        position = self.frame.position(np.array(x) + self.shutter.start(motion)) + self.lift
        return in_reach(position, self.loaded, self.path, "the light's distance")

    def _velocity(
        self, mover: d.PointLight | d.RectangleLight | d.SphereLight | d.Object
    ) -> Floats32 | None:
        if not self.shutter.moves(mover.motion):
            return None
        return np.array(self.shutter.velocity(mover.motion, self.frame), np.float32)


def grid_size(samples: str) -> int:
    """K of ``grid K``."""
    return int(samples.removeprefix("grid "))


def _single(x: Floats64) -> Floats32:
    return x.astype(np.float32)


SEGMENTS = 128
"""Around a visible sphere light; it lies inside the true sphere by at most 3e-4 radii."""


def emitter_parts(
    loaded: Loaded,
    frame: Frame,
    shutter: Shutter,
    first_material: int,
    lifts: Mapping[int, Floats64],
) -> tuple[list[FullPart], list[Floats64]]:
    """Meshes of the visible lights, and the radiance of the material that each of them gets.

    Materials are numbered from ``first_material``; for ``lifts`` see ``course.engine.scene.building.coplanar``.
    SceneError where float32 can't carry a corner or the radiance.
    """
    parts: list[FullPart] = []
    emission: list[Floats64] = []
    for number, light in enumerate(loaded.description.lights):
        if not isinstance(light, d.RectangleLight | d.SphereLight) or light.radiance is None:
            continue
        if isinstance(light, d.RectangleLight) and not light.visible:
            continue
        mesh = rectangle_mesh(light) if isinstance(light, d.RectangleLight) else _sphere(light)
        mesh = Mesh(mesh.vertices + shutter.start(light.motion), mesh.triangles)
        velocity = shutter.velocity(light.motion, frame)
        placed = frame.mesh(mesh)
        if number in lifts:
            placed = Mesh(placed.vertices + lifts[number], placed.triangles)
        in_reach(placed.vertices, loaded, ("lights", number), "the light's far end")
        parts.append(FullPart(placed, first_material + len(emission), velocity))
        radiance = in_range(rgb(light.radiance), loaded, ("lights", number), "the light's radiance")
        emission.append(radiance.astype(np.float64))
    return parts, emission


def rectangle_mesh(light: d.RectangleLight) -> Mesh:
    """The surface of a light, in the units of the scene file."""
    corner, u, v = (np.array(x) for x in (light.corner, light.edge_u, light.edge_v))
    vertices = np.stack((corner, corner + u, corner + u + v, corner + v))
    return Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]))


def _sphere(light: d.SphereLight) -> Mesh:
    ball = shapes.sphere(light.radius, SEGMENTS)
    return Mesh(ball.vertices + np.array(light.center), ball.triangles)
