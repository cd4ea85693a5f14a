"""What stands in for Embree: closed forms, Embree's own hits, and the same bits from both.

Seeds are fixed. Rays through an edge may go either way in Embree; among the stand-ins they may not.
"""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine import shapes
from course.engine.casters.batches import RAYS, BatchCaster
from course.engine.core.accelerator import NO_HIT, Caster, Intersections
from tests.forms import needs_numba
from tests.lengths import fewer

Array = NDArray[np.float32]
Mesh = tuple[Array, NDArray[np.int32]]


def compiled(vertices: Array, triangles: NDArray[np.int32]) -> Caster:
    from course.engine.casters.compiled import CompiledCaster

    return CompiledCaster(vertices, triangles)


def embree(vertices: Array, triangles: NDArray[np.int32]) -> Caster:
    from course.engine.core.embree import EmbreeCaster

    return EmbreeCaster(vertices, triangles)


MAKERS = [
    pytest.param(BatchCaster, id="NumPy"),
    pytest.param(compiled, id="Numba", marks=needs_numba),
]
of_each = pytest.mark.parametrize("make", MAKERS)
Make = Callable[[Array, NDArray[np.int32]], Caster]


def mesh_of(vertices: object, triangles: object) -> Mesh:
    return np.array(vertices, np.float32), np.array(triangles, np.int32)


def heap(seed: int = 8, count: int = 300) -> Mesh:
    """Triangles that go through each other."""
    rng = np.random.default_rng(seed)
    middle = rng.uniform(-0.7, 0.7, (count, 1, 3))
    corners = middle + rng.uniform(-0.2, 0.2, (count, 3, 3))
    return mesh_of(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def knot(segments: int = 64, sides: int = 12) -> Mesh:
    mesh = shapes.torus_knot(2, 3, 0.5, 0.15, segments, sides)
    return mesh_of(mesh.vertices, mesh.triangles)


def stadium() -> Mesh:
    """A knot a thousandth as large as the floor below it."""
    vertices, triangles = knot()
    floor = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    more = np.array([[0, 1, 2], [0, 2, 3]]) + len(vertices)
    return mesh_of(
        np.concatenate((vertices * 1e-3 + [0, 1e-3, 0], floor)), np.concatenate((triangles, more))
    )


MESHES = {"heap": heap, "knot": knot, "stadium": stadium}
of_meshes = pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)


def rays(n: int, seed: int, size: float = 0.7) -> tuple[Array, Array]:
    """From all around towards the middle, directions of any length."""
    rng = np.random.default_rng(seed)
    origin = rng.normal(size=(3, n))
    origin *= 2 / np.linalg.norm(origin, axis=0)
    direction = (rng.uniform(-size, size, (3, n)) - origin) * rng.uniform(0.01, 100, n)
    return origin.astype(np.float32), direction.astype(np.float32)


def ask(caster: Caster, origin: Array, direction: Array, limit: float = NO_HIT) -> Intersections:
    return caster.nearest(origin, direction, np.full(direction.shape[1], limit, np.float32))


def bits(found: Intersections) -> list[bytes]:
    return [np.ascontiguousarray(a).tobytes() for a in (found.triangle, found.u, found.v, found.t)]


ONE = mesh_of([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


@of_each
def test_a_triangle_is_hit_where_the_formula_says(make: Make) -> None:
    rng = np.random.default_rng(1)
    u, v = rng.uniform(-0.2, 1.2, (2, 5000))
    point = np.stack((u, v, 0 * u))
    direction = rng.normal(size=(3, 5000))
    direction[2] = np.where(direction[2] > 0, 1, -1) * rng.uniform(0.3, 2, 5000)
    t = rng.uniform(0.5, 3, 5000)
    origin = (point - t * direction).astype(np.float32)
    found = ask(make(*ONE), origin, direction.astype(np.float32))
    margin = np.minimum(np.minimum(u, v), 1 - u - v)
    sure = np.abs(margin) > 1e-4
    assert ((found.triangle == 0) == (margin > 0))[sure].all()
    hit = found.triangle == 0
    assert 0.2 < hit.mean() < 0.5
    np.testing.assert_allclose(found.t[hit], t[hit], rtol=1e-5)
    np.testing.assert_allclose(found.u[hit], u[hit], atol=1e-5)
    np.testing.assert_allclose(found.v[hit], v[hit], atol=1e-5)
    assert (found.t[~hit] == np.float32(NO_HIT)).all()
    assert (found.u[~hit] == 0).all()


@pytest.mark.parametrize("make", [*MAKERS, pytest.param(embree, id="Embree")])
def test_limits_count_and_negative_ones_ask_nothing(make: Make) -> None:
    caster = make(*ONE)
    origin = np.array([[0.25], [0.25], [2]], np.float32)
    direction = np.repeat(np.array([[0], [0], [-1]], np.float32), 4, axis=1)
    limit = np.array([1.5, 2, 3, -1], np.float32)
    found = caster.nearest(origin, direction, limit.copy())
    assert found.triangle.tolist() == [-1, 0, 0, -1]
    # Embree divides by an approximate reciprocal.
    assert found.t.tolist() == pytest.approx([1.5, 2, 2, -1], rel=1e-6)
    assert caster.free(origin, direction, limit.copy()).tolist() == [True, False, False, True]
    assert caster.free(origin, direction, -1.0).tolist() == [True] * 4
    assert caster.free(origin, direction, 3.0).tolist() == [False] * 4
    assert caster.free(origin, direction, 1.5).tolist() == [True] * 4


@of_each
def test_a_ray_that_starts_on_a_triangle_hits_it_at_zero_and_what_is_behind_is_not_hit(
    make: Make,
) -> None:
    origin = np.array([[0.25, 0.25], [0.25, 0.25], [0, -1e-3]], np.float32)
    direction = np.array([[0, 0], [0, 0], [-1, -1]], np.float32)
    found = ask(make(*ONE), origin, direction)
    assert found.triangle.tolist() == [0, -1]
    assert found.t[0] == 0


@of_each
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_rays_along_the_axes_meet_flat_boxes(make: Make, axis: int) -> None:
    """Two components of the direction are 0, and the triangle's box has no thickness."""
    order = np.roll([0, 1, 2], axis + 1)
    vertices = np.ascontiguousarray(ONE[0][:, np.argsort(order)])
    origin = np.zeros((3, 3), np.float32)
    # One inside, one on the border of the box, one in the plane.
    origin[order[0]], origin[order[1]] = [0.25, 0.0, -1], [0.25, 0.5, 0.25]
    origin[order[2]] = [1, 1, 0]
    direction = np.zeros((3, 3), np.float32)
    direction[order[2], :2] = -3
    direction[order[0], 2] = 1
    found = ask(make(vertices, ONE[1]), origin, direction)
    assert found.triangle.tolist() == [0, 0, -1]
    np.testing.assert_allclose(found.t[:2], 1 / 3, rtol=1e-6)


@of_each
def test_a_triangle_without_area_is_never_hit(make: Make) -> None:
    flat = mesh_of([[0, 0, 0], [1, 0, 0], [0.5, 0, 0]], [[0, 0, 0], [0, 1, 1], [0, 1, 2]])
    origin = np.array([[0.5, 0.0], [0, 0], [1, 1]], np.float32)
    direction = np.array([[0, 0], [0, 0], [-1, -1]], np.float32)
    assert (ask(make(*flat), origin, direction).triangle == -1).all()


@of_each
@pytest.mark.parametrize("copies", [1, 3, 4, 5, 33, 200])
def test_of_several_at_one_distance_the_lowest_number_counts(make: Make, copies: int) -> None:
    """No division can part equal triangles."""
    triangles = np.repeat(ONE[1], copies, axis=0)
    origin = np.array([[0.25], [0.25], [2]], np.float32)
    found = ask(make(ONE[0], triangles), origin, np.array([[0], [0], [-1]], np.float32))
    assert found.triangle.tolist() == [0]


@of_each
@of_meshes
def test_hits_are_those_of_embree(make: Make, mesh: Callable[[], Mesh]) -> None:
    shape = mesh()
    size = 1.4e-3 if mesh is stadium else 0.7
    origin, direction = rays(20_000, 3, size)
    mine, theirs = ask(make(*shape), origin, direction), ask(embree(*shape), origin, direction)
    hit = theirs.triangle >= 0
    assert 0.2 < hit.mean() < 1
    other = np.flatnonzero(mine.triangle != theirs.triangle)
    same = hit & (mine.triangle == theirs.triangle)
    if mesh is stadium:
        # Of a triangle as small as that, float32 tells from so far away only about where it is met.
        assert len(other) <= 1e-3 * hit.sum()
        tolerance = 5e-2
        np.testing.assert_allclose(mine.t[same], theirs.t[same], rtol=2e-6)
    else:
        # Where they differ the ray has met an edge of both, or a border: barycentrics within their rounding of 0.
        assert len(other) <= 3
        for found in (mine, theirs):
            some = other[found.triangle[other] >= 0]
            u, v = found.u[some], found.v[some]
            assert (np.minimum(np.minimum(u, v), 1 - u - v) < 2e-5).all()
        tolerance = 1e-4
    for name in ("t", "u", "v"):
        a, b = getattr(mine, name)[same], getattr(theirs, name)[same]
        np.testing.assert_allclose(a, b, rtol=tolerance, atol=tolerance)


@fewer
@of_each
@of_meshes
@pytest.mark.parametrize("limit", [0.3, 1.0])
def test_what_is_hidden_is_what_embree_says(
    make: Make, mesh: Callable[[], Mesh], limit: float
) -> None:
    shape = mesh()
    origin, direction = rays(20_000, 4)
    direction -= direction - np.float32(2) * direction / np.linalg.norm(direction, axis=0)
    mine = make(*shape).free(origin, direction, np.float32(limit))
    theirs = embree(*shape).free(origin, direction, limit)
    assert (mine != theirs).sum() <= 2
    assert limit < 1 or 0.05 < mine.mean() < 0.95


@needs_numba
@of_meshes
def test_both_hit_the_same_with_the_same_bits(mesh: Callable[[], Mesh]) -> None:
    """Also of rays towards edges and corners, where rounding decides."""
    vertices, triangles = mesh()
    origin, direction = rays(RAYS + 5, 5)
    rng = np.random.default_rng(6)
    corner = vertices[triangles[rng.integers(len(triangles), size=3000)]].transpose(1, 2, 0)
    share = rng.uniform(size=3000) * (rng.random(3000) < 0.7)
    direction[:, :3000] = corner[0] + share * (corner[1] - corner[0]) - origin[:, :3000]
    one, other = BatchCaster(vertices, triangles), compiled(vertices, triangles)
    mine, theirs = ask(one, origin, direction), ask(other, origin, direction)
    if mesh is stadium:
        # Of triangles as small as that, a ray through an edge may pass by the box of one hierarchy, not of the other.
        assert (mine.triangle != theirs.triangle).sum() <= 3
        return
    assert bits(mine) == bits(theirs)
    assert (one.free(origin, direction, 1.0) == other.free(origin, direction, 1.0)).all()


@of_each
def test_a_hit_does_not_depend_on_the_rays_beside_it(make: Make) -> None:
    caster = make(*heap())
    origin, direction = rays(3000, 7)
    found = ask(caster, origin, direction)
    change = np.random.default_rng(9).permutation(3000)
    moved = ask(caster, origin[:, change], direction[:, change])
    assert (found.triangle[change] == moved.triangle).all()
    assert found.t[change].tobytes() == moved.t.tobytes()
    for n in (1, 15, 16, 17):
        few = ask(caster, origin[:, :n], direction[:, :n])
        assert few.t.tobytes() == found.t[:n].tobytes()
    one = np.ascontiguousarray(origin[:, :1])
    shared = ask(caster, one, direction)
    assert bits(shared) == bits(ask(caster, np.repeat(one, 3000, axis=1), direction))


@of_each
def test_no_ray_slips_through_the_edges_of_a_closed_mesh(make: Make) -> None:
    """Rays from inside a ball at points of its edges: each must meet it."""
    ball = shapes.sphere(1.0, 48)
    vertices, triangles = mesh_of(ball.vertices, ball.triangles)
    rng = np.random.default_rng(10)
    n = 100_000
    which, side = rng.integers(len(triangles), size=n), rng.integers(3, size=n)
    p, q = vertices[triangles[which, side]], vertices[triangles[which, (side + 1) % 3]]
    point = (p + rng.uniform(0.01, 0.99, (n, 1)) * (q - p)).T
    origin = rng.uniform(-0.3, 0.3, (3, n)).astype(np.float32)
    found = ask(make(vertices, triangles), origin, (point - origin).astype(np.float32))
    assert (found.triangle < 0).sum() == 0
