"""What leaves a convex object is looked for among the others alone, and found as if all had been asked."""

from typing import Any

import numpy as np
import pytest

from course.engine import shapes
from course.engine.core.accelerator import StaticAccelerator
from course.engine.core.types import Functions
from course.engine.core.vectors import cross, dot
from course.engine.formats.meshes import transforms
from course.engine.formats.yaml import description as d
from course.engine.loops.convex import ConvexObjects, convex_objects
from course.engine.loops.scene_tables import scene_tables
from course.engine.scene.building.objects import CONVEX
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface
from tests.forms import needs_numba

TURN = transforms.compose(
    [
        transforms.rotate(np.array([1.0, 2.0, 3.0]), 33.0),
        transforms.scale(np.array([1.0, 0.3, -2.0])),
        transforms.rotate(np.array([0.0, 1.0, 3.0]), 100.0),
    ]
)
CONVEX_MESHES = {
    "sphere": (d.Sphere, shapes.sphere(0.7, 48)),
    "box": (d.Box, shapes.box((1, 2, 3))),
    "cylinder": (d.Cylinder, shapes.cylinder(0.5, 2, 48)),
    "cone": (d.Cone, shapes.cone(0.5, 2, 48)),
}


def normalised(vectors: Any) -> Any:
    return vectors / np.sqrt(dot(vectors, vectors))


def at(mesh: Mesh, *place: float) -> Mesh:
    return transforms.apply(mesh, transforms.translate(np.array(place)))


def rises(mesh: Mesh) -> float:
    """How far a vertex lies above the plane of a triangle that looks outwards, at most."""
    p = mesh.vertices[mesh.triangles].transpose(1, 2, 0)
    normal = normalised(cross(p[1] - p[0], p[2] - p[0]))
    return float((mesh.vertices @ normal - dot(p[0], normal)).max())


@pytest.mark.parametrize("name", CONVEX_MESHES)
@pytest.mark.parametrize("matrix", [np.eye(4), TURN], ids=["as it is", "transformed"])
def test_the_shapes_that_count_as_convex_are(name: str, matrix: Any) -> None:
    kind, mesh = CONVEX_MESHES[name]
    assert kind in CONVEX
    assert len(CONVEX) == len(CONVEX_MESHES)
    assert rises(transforms.apply(mesh, matrix)) < 1e-12


def test_the_measure_finds_what_is_not_convex() -> None:
    assert rises(shapes.torus(1.0, 0.25, 48, 24)) > 0.1
    assert rises(shapes.displaced_sphere(1.0, 0.1, 4.0, 48)) > 1e-3


BALL, SMALL = shapes.sphere(0.25, 64), shapes.sphere(0.25, 24)
KNOT = at(shapes.torus_knot(2, 3, 0.3, 0.1, 256, 24), 0, -0.5, 0.3)
ROOM = shapes.box((2, 2, 2))


def scene(*parts: tuple[Mesh, bool]) -> FullSurface:
    return build_surface([FullPart(mesh, 0, convex=convex) for mesh, convex in parts])


def apart() -> FullSurface:
    """Two balls that are worth being left out, between a small ball and two objects that are not convex."""
    return scene(
        (at(SMALL, 0, 0.1, 0), True),
        (at(BALL, -0.6, 0, 0), True),
        (KNOT, False),
        (at(BALL, 0.6, 0.2, 0.1), True),
        (at(shapes.quad(0.5, 0.5), 0, -0.9, 0), False),
    )


def objects(surface: FullSurface) -> ConvexObjects | None:
    """What compiled loops would look at, whether there are any or not."""
    asked = surface.accelerator
    assert isinstance(asked, StaticAccelerator)
    return convex_objects(asked.vertices, asked.triangles, surface.triangles.parts)


def test_balls_that_stand_apart_are_worth_it() -> None:
    found = objects(apart())
    assert found is not None
    assert found.worth.tolist() == [False, True, False, True, False]
    sizes = np.diff(found.first)
    assert sizes.tolist() == [len(m.triangles) for m in (SMALL, BALL, KNOT, BALL)] + [2]
    low, high = found.boxes[2:4]
    assert np.allclose(low, (-0.85, -0.25, -0.25), atol=1e-4)
    assert np.allclose(high, (-0.35, 0.25, 0.25), atol=1e-4)
    # The balls' farthest points lie in the boxes, with room.
    assert low[0] < -0.85
    assert high[0] > -0.35


@pytest.mark.parametrize(
    ("parts", "why"),
    [
        ([(BALL, False)], "not convex"),
        ([(SMALL, True)], "few triangles"),
        ([(BALL, True), (ROOM, False)], "every ray meets the room"),
        ([(BALL, True)] + [(at(SMALL, x / 9 - 0.9, 0.9, 0), False) for x in range(16)], "many"),
        ([(Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]])), True)], "nothing"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_nothing_is_looked_at_where_it_does_not_pay(parts: Any, why: str) -> None:
    assert objects(scene(*parts)) is None, why


def test_an_object_without_area_is_in_nobodys_way() -> None:
    nothing = Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]]))
    found = objects(scene((BALL, True), (nothing, False)))
    assert found is not None
    assert found.worth.tolist() == [True, False]


@needs_numba
def test_where_things_move_nothing_is_left_out() -> None:
    functions = Functions(
        displacement=lambda velocity, time: velocity[:, None] * time,
        to_object_space=lambda origins, velocity, time: origins - velocity[:, None] * time,
    )
    parts = [FullPart(BALL, 0, convex=True), FullPart(at(BALL, 0.6, 0, 0), 0, (0.1, 0.0, 0.0))]
    still, moving = (build_surface(some, functions) for some in (parts[:1], parts))
    assert scene_tables(still.accelerator, still.triangles.parts).convex is not None
    assert scene_tables(moving.accelerator, moving.triangles.parts).convex is None
