"""Lights of triangles, of shapes as a scene compiles them, and points to look at them from."""

import numpy as np

from course.engine import shapes
from course.engine.core.types import Floats32
from course.engine.shapes.mesh import Mesh
from course.engine.terms.lights.mesh_light import MeshLight, areas, shares
from course.engine.terms.surfaces.surface import build_surface
from course.engine.terms.surfaces.tables import Part


def lamp(mesh: Mesh) -> MeshLight:
    """A light of a mesh, of power 1 by area."""
    surface = build_surface([Part(mesh, 0)])
    return MeshLight(
        "light 0",
        shares(areas(surface.triangles.edges)),
        surface.triangles.planes,
        surface.triangles.edges,
        np.ones(3, np.float32),
    )


def moved(mesh: Mesh, scale: float, x: float = 0.0, turned: bool = False) -> Mesh:
    """A flat mesh of another size, along x; turned inside out if that is wanted."""
    triangles = mesh.triangles[:, ::-1] if turned else mesh.triangles
    return Mesh(mesh.vertices * scale + [x, 0, 0], np.ascontiguousarray(triangles))


def without(mesh: Mesh, *missing: int) -> Mesh:
    """A flat mesh that lacks some triangles."""
    return Mesh(mesh.vertices, np.delete(mesh.triangles, missing, axis=0))


KNOT = shapes.torus_knot(radius=0.3, tube=0.06, segments=128, sides=12)
BALL = shapes.sphere(0.3, 48)


def around(n: int, distance: float, seed: int) -> Floats32:
    """Points (3, n) all around the origin."""
    directions = np.random.default_rng(seed).normal(size=(3, n))
    points: Floats32 = np.float32(distance) * (
        directions / np.linalg.norm(directions, axis=0)
    ).astype(np.float32)
    return points
