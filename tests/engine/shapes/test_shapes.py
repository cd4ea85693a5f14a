"""Laws of the named shapes, against closed forms."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine import shapes
from course.engine.shapes.mesh import Mesh
from course.engine.shapes.tubes import thickest_tube

# Every closed shape with its Euler characteristic, coarse and fine, thin and thick, tiny and huge.
CLOSED: dict[str, tuple[Mesh, int]] = {
    "box": (shapes.box((1.0, 2.0, 3.0)), 2),
    "box, tiny and flat": (shapes.box((1e-30, 1e-3, 1e30)), 2),
    "sphere": (shapes.sphere(), 2),
    "sphere, coarsest": (shapes.sphere(2.0, 3), 2),
    "sphere, odd": (shapes.sphere(1e-30, 17), 2),
    "sphere, huge": (shapes.sphere(1e30, 16), 2),
    "cylinder": (shapes.cylinder(), 2),
    "cylinder, coarsest": (shapes.cylinder(3.0, 0.1, 3), 2),
    "cone": (shapes.cone(), 2),
    "cone, coarsest": (shapes.cone(5.0, 0.5, 3), 2),
    "torus": (shapes.torus(), 0),
    "torus, coarsest": (shapes.torus(1.0, 0.999, 3, 3), 0),
    "torus knot": (shapes.torus_knot(), 0),
    "torus knot, coarsest": (shapes.torus_knot(2, 3, 2.0, 0.8, 40, 8), 0),
    "torus knot, a circle": (shapes.torus_knot(1, 1, 1.0, 0.7, 64, 8), 0),
    "torus knot, wound": (shapes.torus_knot(3, 7, 1.0, 0.2, 1024, 8), 0),
    "displaced sphere": (shapes.displaced_sphere(), 2),
    "displaced sphere, deep": (shapes.displaced_sphere(2.0, 1.9, 4.0, 128, seed=7), 2),
    "displaced sphere, coarsest": (shapes.displaced_sphere(1.0, 0.1, 1.0, 3), 2),
}
OPEN: dict[str, Mesh] = {
    "quad": shapes.quad(2.0, 3.0),
    "disk": shapes.disk(),
    "disk, coarsest": shapes.disk(2.0, 3),
    "height field": shapes.height_field(),
    "height field, one cell": shapes.height_field((1.0, 1e-6), 10.0, 3.0, 1, seed=3),
    "height field, long": shapes.height_field((7.0, 0.5), 0.2, 4.0, 64, seed=1),
}
EVERY = {**{name: mesh for name, (mesh, _) in CLOSED.items()}, **OPEN}

every_shape = pytest.mark.parametrize("mesh", EVERY.values(), ids=EVERY.keys())
closed_shape = pytest.mark.parametrize(("mesh", "euler"), CLOSED.values(), ids=CLOSED.keys())


def welded(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Places and triangles between them, vertices of identical coordinates taken as one."""
    # + 0.0 makes -0.0 into 0.0, so that only bits are compared, without a tolerance.
    places, which = np.unique(mesh.vertices + 0.0, axis=0, return_inverse=True)
    return places, which.reshape(-1)[mesh.triangles]


def edges(triangles: NDArray[np.intp]) -> NDArray[np.intp]:
    """Directed edges of all triangles, (3 T, 2)."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def area_vectors(mesh: Mesh) -> NDArray[np.float64]:
    p0, p1, p2 = mesh.vertices[mesh.triangles].transpose(1, 0, 2)
    return np.asarray(0.5 * np.cross(p1 - p0, p2 - p0))


def area(mesh: Mesh) -> float:
    return float(np.sum(np.linalg.norm(area_vectors(mesh), axis=1)))


def volume(mesh: Mesh) -> float:
    """By the divergence theorem: positive when the winding faces outwards."""
    p0 = mesh.vertices[mesh.triangles[:, 0]]
    return float(np.sum(p0 * area_vectors(mesh)) / 3.0)


@closed_shape
def test_a_closed_shape_is_closed_and_faces_outwards(mesh: Mesh, euler: int) -> None:
    """Each edge once in either direction, and its Euler characteristic."""
    places, triangles = welded(mesh)
    directed, times = np.unique(edges(triangles), axis=0, return_counts=True)
    assert np.all(times == 1)
    backwards = np.unique(directed[:, ::-1], axis=0)
    np.testing.assert_array_equal(backwards, directed)
    assert not np.any(directed[:, 0] == directed[:, 1])
    # Each undirected edge is two directed ones.
    assert len(places) - len(directed) // 2 + len(triangles) == euler
    assert volume(mesh) > 0.0


@every_shape
def test_every_triangle_has_an_area(mesh: Mesh) -> None:
    p0, p1, p2 = mesh.vertices[mesh.triangles].transpose(1, 0, 2)
    longest = np.max(np.abs([p1 - p0, p2 - p1, p0 - p2]), axis=(0, 2))
    assert np.all(longest > 0.0)
    assert np.all(np.any(area_vectors(mesh) != 0.0, axis=1))


@every_shape
def test_arrays_have_the_shapes_and_types_of_a_mesh(mesh: Mesh) -> None:
    count = len(mesh.vertices)
    assert mesh.normals is not None
    assert mesh.uv is not None
    assert (mesh.vertices.shape, mesh.vertices.dtype) == ((count, 3), np.float64)
    assert (mesh.normals.shape, mesh.normals.dtype) == ((count, 3), np.float64)
    assert (mesh.uv.shape, mesh.uv.dtype) == ((count, 2), np.float64)
    assert mesh.triangles.shape[1:] == (3,)
    assert mesh.triangles.dtype == np.int32
    np.testing.assert_array_equal(np.unique(mesh.triangles), np.arange(count))


@every_shape
def test_normals_are_unit_and_uv_in_the_unit_square(mesh: Mesh) -> None:
    assert mesh.normals is not None
    assert mesh.uv is not None
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, rtol=0.0, atol=1e-15)
    assert mesh.uv.min() >= 0.0
    assert mesh.uv.max() <= 1.0
    # Not all the same: they span most of the square.
    assert np.all(np.ptp(mesh.uv, axis=0) >= 0.75)


# A coarse mesh of a steep surface has facets that turn further than its normals.
SMOOTH_ENOUGH = [name for name in EVERY if name not in {"height field, one cell"}]


@pytest.mark.parametrize("name", SMOOTH_ENOUGH)
def test_winding_agrees_with_every_normal(name: str) -> None:
    mesh = EVERY[name]
    assert mesh.normals is not None
    facing = area_vectors(mesh)
    facing /= np.linalg.norm(facing, axis=1, keepdims=True)
    assert np.all(np.sum(facing[:, None] * mesh.normals[mesh.triangles], axis=2) > 0.0)


@every_shape
def test_uv_is_never_mirrored(mesh: Mesh) -> None:
    assert mesh.uv is not None
    t0, t1, t2 = mesh.uv[mesh.triangles].transpose(1, 0, 2)
    a, b = t1 - t0, t2 - t0
    assert np.all(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0.0)


def test_seam_vertices_have_the_same_bits() -> None:
    # The columns u = 0 and u = 1 of a sphere, at the same v, differ in nothing but u.
    mesh = shapes.displaced_sphere(segments=31, seed=5)
    assert mesh.uv is not None
    assert mesh.normals is not None
    first, last = (np.flatnonzero(mesh.uv[:, 0] == u) for u in (0.0, 1.0))
    assert len(first) == len(last) == 31 // 2 - 1
    np.testing.assert_array_equal(mesh.vertices[first], mesh.vertices[last])
    np.testing.assert_array_equal(mesh.normals[first], mesh.normals[last])


@pytest.mark.parametrize("segments", [3, 4, 63, 64])
def test_pole_of_a_sphere_is_one_vertex(segments: int) -> None:
    mesh = shapes.sphere(2.0, segments)
    for y in (-2.0, 2.0):
        np.testing.assert_array_equal(
            mesh.vertices[np.abs(mesh.vertices[:, 1] - y) < 1e-12], [[0.0, y, 0.0]]
        )


# -- closed forms: inscribed meshes fall short by O(1 / segments^2), with these factors ------------


def polygon(segments: int) -> float:
    """Area of a regular polygon over that of its circle."""
    return math.sin(2.0 * math.pi / segments) / (2.0 * math.pi / segments)


@pytest.mark.parametrize("segments", [16, 64, 256])
def test_sphere_tends_to_its_volume_and_area(segments: int) -> None:
    mesh, r = shapes.sphere(2.0, segments), 2.0
    # Facets span 2 pi / n along and across, so that the convex mesh holds a ball that touches one
    # with a diagonal of sqrt(2) times that, and lies in the sphere: monotone for convex bodies.
    inner = math.cos(math.sqrt(2.0) * math.pi / segments)
    exact_volume, exact_area = 4.0 / 3.0 * math.pi * r**3, 4.0 * math.pi * r**2
    assert exact_volume * inner**3 < volume(mesh) < exact_volume
    assert exact_area * inner**2 < area(mesh) < exact_area


@pytest.mark.parametrize("segments", [3, 8, 200])
def test_cylinder_is_the_prism_over_its_polygon(segments: int) -> None:
    mesh, r, h = shapes.cylinder(0.5, 3.0, segments), 0.5, 3.0
    base = math.pi * r * r * polygon(segments)
    around = 2.0 * segments * r * math.sin(math.pi / segments)
    assert volume(mesh) == pytest.approx(base * h, rel=1e-13)
    assert area(mesh) == pytest.approx(2.0 * base + around * h, rel=1e-13)


@pytest.mark.parametrize("segments", [3, 8, 200])
def test_cone_is_the_pyramid_over_its_polygon(segments: int) -> None:
    mesh, r, h = shapes.cone(0.5, 3.0, segments), 0.5, 3.0
    base = math.pi * r * r * polygon(segments)
    slant = math.hypot(h, r * math.cos(math.pi / segments))
    sides = segments * r * math.sin(math.pi / segments) * slant
    assert volume(mesh) == pytest.approx(base * h / 3.0, rel=1e-13)
    assert area(mesh) == pytest.approx(base + sides, rel=1e-13)


def test_box_quad_and_disk_have_their_volume_and_area() -> None:
    assert volume(shapes.box((1.0, 2.0, 3.0))) == pytest.approx(6.0, rel=1e-15)
    assert area(shapes.box((1.0, 2.0, 3.0))) == pytest.approx(22.0, rel=1e-15)
    assert area(shapes.quad(2.0, 3.0)) == 6.0
    assert area(shapes.disk(2.0, 7)) == pytest.approx(4.0 * math.pi * polygon(7), rel=1e-14)


@pytest.mark.parametrize(("segments", "sides"), [(16, 12), (96, 48), (256, 128)])
def test_torus_tends_to_its_volume_and_area(segments: int, sides: int) -> None:
    big, small = 2.0, 0.5
    mesh = shapes.torus(big, small, segments, sides)
    # Each circle falls short by at most (2 pi / n)^2 / 6; twice for the pairs of triangles that
    # bend inwards where the torus is a saddle.
    short = ((2.0 * math.pi / segments) ** 2 + (2.0 * math.pi / sides) ** 2) / 3.0
    exact_volume = 2.0 * math.pi**2 * big * small**2
    exact_area = 4.0 * math.pi**2 * big * small
    assert exact_volume * (1.0 - short) < volume(mesh) < exact_volume
    assert exact_area * (1.0 - short) < area(mesh) < exact_area


@pytest.mark.parametrize(("p", "q", "tube"), [(2, 3, 0.2), (3, 2, 0.2), (2, 5, 0.1), (1, 1, 0.5)])
def test_torus_knot_has_the_volume_and_area_of_a_tube(p: int, q: int, tube: float) -> None:
    """Pappus for tubes that meet themselves nowhere: section times length (Weyl 1939)."""
    mesh = shapes.torus_knot(p, q, 1.0, tube, 2048, 64)
    turn = np.arange(100_000) * (2.0 * math.pi / 100_000)
    speed = np.sqrt((q / 2.0) ** 2 + ((1.0 + 0.5 * np.cos(q * turn)) * p) ** 2)
    length = 2.0 * math.pi * float(np.mean(speed))
    assert volume(mesh) == pytest.approx(math.pi * tube**2 * length, rel=3e-3)
    assert area(mesh) == pytest.approx(2.0 * math.pi * tube * length, rel=3e-3)


def test_displaced_sphere_without_amplitude_is_the_sphere() -> None:
    still, sphere = shapes.displaced_sphere(2.0, 0.0, 6.0, 32), shapes.sphere(2.0, 32)
    np.testing.assert_array_equal(still.vertices, sphere.vertices)
    assert still.normals is not None
    np.testing.assert_allclose(still.normals, sphere.normals, rtol=0.0, atol=1e-15)


# -- normals ---------------------------------------------------------------------------------------


def sphere_normals(p: NDArray[np.float64]) -> NDArray[np.float64]:
    return p / 2.0


def torus_normals(p: NDArray[np.float64]) -> NDArray[np.float64]:
    middle = p * [1.0, 0.0, 1.0]
    middle *= 2.0 / np.linalg.norm(middle, axis=1, keepdims=True)
    return np.asarray((p - middle) / 0.5)


@pytest.mark.parametrize(
    ("mesh", "exact"),
    [(shapes.sphere(2.0, 20), sphere_normals), (shapes.torus(2.0, 0.5, 20, 10), torus_normals)],
    ids=["sphere", "torus"],
)
def test_normals_equal_the_analytic_ones(
    mesh: Mesh, exact: Callable[[NDArray[np.float64]], NDArray[np.float64]]
) -> None:
    np.testing.assert_allclose(mesh.normals, exact(mesh.vertices), rtol=0.0, atol=4e-15)


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.torus_knot(2, 3, 1.0, 0.3, 1024, 64),
        shapes.displaced_sphere(2.0, 0.3, 6.0, 512, seed=11),
        shapes.height_field((3.0, 2.0), 0.3, 4.0, 256, seed=2),
    ],
    ids=["torus knot", "displaced sphere", "height field"],
)
def test_normals_are_orthogonal_to_the_surface(mesh: Mesh) -> None:
    """A triangle's edge leaves the tangent plane at its start by its length times the curvature.

    With some 85 steps or more to a wave all of them stay below 0.1 rad.
    """
    assert mesh.normals is not None
    a, b = edges(mesh.triangles.astype(np.intp)).T
    along = mesh.vertices[b] - mesh.vertices[a]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    assert np.max(np.abs(np.sum(along * mesh.normals[a], axis=1))) < 0.1
    # The two ends' normals average to orthogonal, one order better.
    middle = 0.5 * (mesh.normals[a] + mesh.normals[b])
    assert np.max(np.abs(np.sum(along * middle, axis=1))) < 5e-3


def test_cone_and_cylinder_sides_have_analytic_normals() -> None:
    cone = shapes.cone(3.0, 4.0, 12)
    cylinder = shapes.cylinder(3.0, 4.0, 12)
    for mesh, up in ((cone, 0.6), (cylinder, 0.0)):
        assert mesh.normals is not None
        side = np.flatnonzero(np.abs(mesh.normals[:, 1]) < 0.9)
        np.testing.assert_allclose(mesh.normals[side, 1], up, rtol=0.0, atol=1e-15)
        rim = side[mesh.vertices[side, 1] < 0.0]
        outwards = mesh.vertices[rim] * [1.0, 0.0, 1.0] / 3.0
        np.testing.assert_allclose(
            mesh.normals[rim] * [1.0, 0.0, 1.0],
            outwards * math.sqrt(1.0 - up * up),
            rtol=0.0,
            atol=1e-15,
        )


@pytest.mark.parametrize("mesh", [shapes.box((1.0, 2.0, 3.0)), shapes.quad(), shapes.disk()])
def test_flat_faces_have_exact_face_normals(mesh: Mesh) -> None:
    assert mesh.normals is not None
    facing = area_vectors(mesh)
    facing /= np.linalg.norm(facing, axis=1, keepdims=True)
    for corner in range(3):
        np.testing.assert_array_equal(mesh.normals[mesh.triangles[:, corner]], facing)


# -- parameters ------------------------------------------------------------------------------------


def test_displacement_keeps_to_its_amplitude_and_uses_it() -> None:
    distance = np.linalg.norm(shapes.displaced_sphere(2.0, 0.3, 6.0, 64).vertices, axis=1)
    height = shapes.height_field(amplitude=0.3).vertices[:, 1]
    for values in (distance - 2.0, height):
        assert 0.1 < np.max(np.abs(values)) <= 0.3
        assert values.min() < 0.0 < values.max()


def test_seed_chooses_the_bumps_and_repeats_them() -> None:
    def bumps(seed: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        return (
            shapes.displaced_sphere(segments=16, seed=seed).vertices,
            shapes.height_field(segments=16, seed=seed).vertices,
        )

    for first, again, other in zip(bumps(1), bumps(1), bumps(2), strict=True):
        np.testing.assert_array_equal(first, again)
        assert np.max(np.abs(first - other)) > 0.01


def test_shapes_are_centred_and_sized_as_asked() -> None:
    extents = {
        (2.0, 0.0, 3.0): shapes.quad(2.0, 3.0),
        (1.0, 2.0, 3.0): shapes.box((1.0, 2.0, 3.0)),
        (4.0, 4.0, 4.0): shapes.sphere(2.0, 64),
        (2.0, 0.0, 2.0): shapes.disk(1.0, 64),
        (2.0, 3.0, 2.0): shapes.cylinder(1.0, 3.0, 64),
        (2.0, 5.0, 2.0): shapes.cone(1.0, 5.0, 64),
        (5.0, 1.0, 5.0): shapes.torus(2.0, 0.5, 64, 64),
    }
    for size, mesh in extents.items():
        np.testing.assert_allclose(mesh.vertices.max(axis=0), np.array(size) / 2.0, atol=1e-15)
        np.testing.assert_allclose(mesh.vertices.min(axis=0), np.array(size) / -2.0, atol=1e-15)


def test_thickest_tube_of_known_curves() -> None:
    # Between two strands on opposite sides of the inner torus there is about 1, less their slant.
    assert 0.35 < thickest_tube(2, 3) < 0.5
    # q strands share the inner torus' circumference of pi: none is thicker than half a share.
    assert thickest_tube(1, 20) < math.pi / 20 / 2.0 * 1.01


@pytest.mark.parametrize(("p", "q"), [(2, 3), (3, 2), (5, 2), (3, 7)])
def test_refused_tubes_overlap_and_accepted_ones_do_not(p: int, q: int) -> None:
    """On either side of the limit, vertices lie nearer to a far part of the knot than the tube."""
    limit = thickest_tube(p, q)
    with pytest.raises(ValueError, match="begins to meet itself"):
        shapes.torus_knot(p, q, 1.0, limit * 1.001)
    steps = 512
    mesh = shapes.torus_knot(p, q, 1.0, limit * 0.98, steps, 32)
    rings = mesh.vertices.reshape(33, steps + 1, 3)[:-1, :-1]
    # Opposite points of a ring of an even number of sides have its centre in their middle.
    curve = 0.5 * (rings[0] + rings[16])
    nearest = min(
        float(np.min(np.linalg.norm(ring[:, None] - curve[None], axis=2))) for ring in rings[::4]
    )
    assert nearest > limit * 0.98 * 0.99
