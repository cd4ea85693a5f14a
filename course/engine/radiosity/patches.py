"""A scene's surfaces as patches: small triangles that are given one radiosity each, front and back.

Of T triangles, patch t is the front of triangle t, and patch T + t its back: P = 2 T. Lengths are those of the compiled
scene (``course.engine.scene.building.frame``).
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from course.engine import shapes
from course.engine.core.types import Floats32, Floats64, Indices, Mask
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Effects
from course.engine.radiosity.accepting import check_accepted
from course.engine.scene.building.cutting import bisected, undivided
from course.engine.scene.building.frame import Frame
from course.engine.scene.building.lights import rectangle_mesh
from course.engine.scene.building.materials import base_color
from course.engine.scene.building.objects import object_mesh
from course.engine.scene.building.triangles import SharedTriangles
from course.engine.scene.scene import Scene
from course.engine.shapes.mesh import Mesh


class RadiosityFunctions:
    """The functions of the radiosity module by their names; each is looked up when it is first called."""

    def __init__(self, effects: Effects) -> None:
        self._effects = effects

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """See ``Effects.function``."""
        return self._effects.function("radiosity", name)


MOST = 100_000
"""Triangles; beyond it most cells of a hemicube would see a patch of their own."""

LAMP_SIZE = 8.0
"""Patches of lamps are this many times as large as others: they shoot once, through finer hemicubes."""

LAMP_SEGMENTS = 16
"""Around a sphere light."""

WELDED = 9
"""Decimals in which vertices have to agree to be one, in a scene that fills [-1, 1]."""


@dataclass(frozen=True)
class Patches:
    """T triangles with what is the same all over each of them.

    Attributes
    ----------
    triangles : the patches' shapes, in the unit of the compiled scene
    reflectance : (3, T) float32, of either side
    emission : (3, T) float32 [W/m^2], radiosity that the front has by itself
    surface : (T,) intp, number of the smooth surface that the triangle is a part of
    two_sided : (T,) which triangles emit from their backs as well, None where none does
    """

    triangles: SharedTriangles
    reflectance: Floats32
    emission: Floats32
    surface: Indices
    two_sided: Mask | None = None

    @property
    def size(self) -> int:
        """Number of triangles T; there are twice as many patches."""
        return self.triangles.size

    @property
    def lamps(self) -> Mask:
        """(T,) which triangles emit and reflect nothing: their light is the same all over."""
        return np.asarray(self.emission.any(axis=0) & ~self.reflectance.any(axis=0))

    @property
    def back_emission(self) -> Floats32:
        """(3, T) float32 [W/m^2], radiosity that the backs have by themselves."""
        if self.two_sided is None:
            return np.zeros_like(self.emission)
        return self.emission * self.two_sided

    def both(self, front: Floats32, back: Floats32 | None = None) -> Floats32:
        """(..., P) numbers of all patches from the triangles' (..., T), the same for both sides by default."""
        return np.concatenate((front, front if back is None else back), axis=-1)

    def split(self, chosen: Mask) -> "Patches":
        """Halve the chosen triangles, and what has to be halved with them."""
        whole = replace(self.triangles, origin=np.arange(self.size))
        parts = bisected(whole, chosen)
        parent = parts.origin
        return Patches(
            replace(parts, origin=self.triangles.origin[parent]),
            self.reflectance[:, parent],
            self.emission[:, parent],
            self.surface[parent],
            None if self.two_sided is None else self.two_sided[parent],
        )


def make_patches(scene: Scene, count: int) -> Patches:
    """Divide a scene's surfaces evenly until there are that many triangles; those of its meshes if they are more.

    Raises SceneError: the scene is none for radiosity, or its meshes have too many triangles.
    """
    check_accepted(scene.loaded)
    patches = _undivided(scene)
    while patches.size < count:
        size = patches.triangles.areas() / np.where(patches.lamps, LAMP_SIZE, 1)
        # The largest first; most have a neighbour that is halved with them.
        chosen = np.zeros(patches.size, bool)
        largest = np.argsort(-size, kind="stable")[: max((count - patches.size) // 2, 1)]
        chosen[largest[size[largest] > 0.75 * size[largest[0]]]] = True
        patches = patches.split(chosen)
    return patches


def _undivided(scene: Scene) -> Patches:
    meshes, reflectance, emission = zip(*_meshes(scene.loaded, scene.compiled.frame), strict=True)
    counts = [len(mesh.triangles) for mesh in meshes]
    objects = len(scene.loaded.description.objects)
    if sum(counts) > MOST:
        most = int(np.argmax(counts[:objects]))
        raise scene.loaded.document.error(
            ("objects", most),
            f"the scene has {sum(counts)} triangles, most of them here: expected at most {MOST} for radiosity; "
            "give its shapes fewer segments",
        )
    vertices, corners = _welded(meshes)
    p = vertices.astype(np.float32).astype(np.float64)[corners]
    has_area = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]).any(axis=1)
    surface = np.concatenate([_surfaces(mesh) for mesh in meshes])
    number = np.repeat(np.arange(len(meshes)), counts)
    _, surface = np.unique(np.stack((number, surface)), axis=1, return_inverse=True)
    return Patches(
        undivided(vertices, corners[has_area]),
        np.stack(reflectance, axis=1)[:, number[has_area]].astype(np.float32),
        np.stack(emission, axis=1)[:, number[has_area]].astype(np.float32),
        surface.ravel()[has_area],
        # What glows by itself does so all around, a lamp from its front.
        (number < objects)[has_area],
    )


def _meshes(loaded: Loaded, frame: Frame) -> Iterator[tuple[Mesh, Floats64, Floats64]]:
    """Each object and lamp, its reflectance and what it emits."""
    scene = loaded.description
    black = np.zeros(3)
    for number, thing in enumerate(scene.objects):
        material = scene.materials[thing.material]
        mesh = object_mesh(thing, number, loaded.document, loaded.path.parent)
        # A Lambertian emitter's radiosity is pi times its radiance.
        glow = math.pi * rgb(material.emission)
        yield frame.mesh(mesh), base_color(material) * material.diffuse, glow
    for light in scene.lights:
        if isinstance(light, d.RectangleLight | d.SphereLight) and light.radiance is not None:
            yield frame.mesh(_lamp(light)), black, math.pi * rgb(light.radiance)


def _lamp(light: d.RectangleLight | d.SphereLight) -> Mesh:
    if isinstance(light, d.RectangleLight):
        return rectangle_mesh(light)
    ball = shapes.sphere(1.0, LAMP_SEGMENTS)
    area = undivided(ball.vertices, np.asarray(ball.triangles, np.intp)).areas().sum()
    # As large as the sphere is, so that it sends out as much light.
    radius = light.radius * math.sqrt(4 * math.pi / area)
    return Mesh(ball.vertices * radius + np.array(light.center), ball.triangles, ball.normals)


def _welded(meshes: tuple[Mesh, ...]) -> tuple[Floats64, Indices]:
    """All vertices and all corners; vertices at the same place are one."""
    start = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])[:-1]
    corners = np.concatenate([m.triangles + s for m, s in zip(meshes, start, strict=True)])
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    _, first, number = np.unique(
        np.round(vertices, WELDED) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    return vertices[first], number.ravel()[corners].astype(np.intp)


def _surfaces(mesh: Mesh) -> Indices:
    """(T,) which triangles of a mesh shade smoothly into each other."""
    corners = np.asarray(mesh.triangles, np.intp)
    if mesh.normals is not None:
        # A mesh with normals has two vertices where it has an edge.
        count = len(mesh.vertices)
        ends = np.concatenate((corners[:, :2], corners[:, 1:]))
        graph = coo_array((np.ones(len(ends), bool), tuple(ends.T)), shape=(count, count))
        _, component = connected_components(graph, directed=False)
        return np.asarray(component[corners[:, 0]], np.intp)
    p = mesh.vertices[corners]
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.finfo(float).tiny)
    _, number = np.unique(np.round(normal, 6) + 0.0, axis=0, return_inverse=True)
    return np.asarray(number.ravel(), np.intp)
