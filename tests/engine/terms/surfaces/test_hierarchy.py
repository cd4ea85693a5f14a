"""Triangles in the hierarchy of the bounding_volumes module, beside the same triangles in Embree.

Rays through an edge may go either way, and so may those towards the border of the whole; seeds are fixed.
"""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.base.errors import EffectError
from course.engine import shapes
from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import NO_HIT, QueryStats, StaticAccelerator
from course.engine.core.types import Functions
from course.engine.core.vectors import dot
from course.engine.functions.effects import Effects
from course.engine.terms.surfaces.hierarchy import HierarchyAccelerator

N = 4000
Array = NDArray[np.float32]
Pair = tuple[HierarchyAccelerator, StaticAccelerator]


def functions(**replaced: Any) -> Functions:
    effects = Effects("solutions")
    given = {name: effects.function("bounding_volumes", name) for name in ("build", "traverse")}
    return Functions(**(given | replaced))


def both(
    vertices: NDArray[np.floating], triangles: NDArray[np.integer], leaf_size: int = 4
) -> Pair:
    shape = vertices.astype(np.float32), triangles.astype(np.int32)
    return HierarchyAccelerator(*shape, functions(), leaf_size), static_accelerator(*shape)


@pytest.fixture(scope="module", params=["knot", "heap"])
def pair(request: pytest.FixtureRequest) -> Pair:
    """A closed shape, and triangles that go through each other."""
    if request.param == "knot":
        mesh = shapes.torus_knot(2, 3, 0.5, 0.15, 64, 12)
        return both(mesh.vertices, mesh.triangles)
    rng = np.random.default_rng(8)
    middle = rng.uniform(-0.7, 0.7, (300, 1, 3))
    vertices = (middle + rng.uniform(-0.2, 0.2, (300, 3, 3))).reshape(-1, 3)
    return both(vertices, np.arange(900).reshape(-1, 3), leaf_size=3)


def rays(seed: int) -> tuple[Array, Array]:
    """From all around towards the middle, directions of any length."""
    rng = np.random.default_rng(seed)
    origin = rng.normal(size=(3, N))
    origin *= 2 / np.linalg.norm(origin, axis=0)
    direction = rng.uniform(-0.7, 0.7, (3, N)) - origin
    return origin.astype(np.float32), direction.astype(np.float32)


def test_hits_are_those_of_embree(pair: Pair) -> None:
    origin, direction = rays(1)
    mine, theirs = (each.intersect(origin, direction, QueryStats()) for each in pair)
    same = mine.triangle == theirs.triangle
    assert (theirs.triangle >= 0).mean() > 0.3
    assert (~same).sum() <= 3
    assert mine.triangle.dtype == np.int32
    assert {each.dtype for each in (mine.u, mine.v, mine.t)} == {np.dtype(np.float32)}
    hit = same & (theirs.triangle >= 0)
    np.testing.assert_allclose(mine.t[hit], theirs.t[hit], rtol=1e-5)
    # Barycentrics lose digits where a ray grazes; half of the rays are far from that.
    off = np.maximum(abs(mine.u - theirs.u), abs(mine.v - theirs.v))[hit]
    assert np.median(off) < 1e-5
    assert np.quantile(off, 0.99) < 1e-3
    assert (mine.t[same & ~hit] == NO_HIT).all()


def test_places_are_in_the_triangle_and_on_the_ray(pair: Pair) -> None:
    origin, direction = rays(2)
    hierarchy, _ = pair
    found = hierarchy.intersect(origin, direction, QueryStats())
    hit = np.flatnonzero(found.triangle >= 0)
    u, v = found.u[hit].astype(np.float64), found.v[hit].astype(np.float64)
    assert min(u.min(), v.min()) >= 0
    assert (u + v).max() <= 1 + 1e-7
    corners = [corner[:, found.triangle[hit]].astype(np.float64) for corner in hierarchy._corners]
    point = corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v
    along = direction[:, hit].astype(np.float64)
    along /= np.linalg.norm(along, axis=0)
    beside = point - origin[:, hit]
    beside -= along * dot(beside, along)
    assert np.linalg.norm(beside, axis=0).max() < 2e-6


@pytest.mark.parametrize("limit", [0.6, 1.0, 1e30])
def test_what_hides_a_light_is_what_embree_says(pair: Pair, limit: float) -> None:
    origin, direction = rays(3)
    free, expected = (each.unoccluded(origin, direction, limit, QueryStats()) for each in pair)
    assert 0.05 < expected.mean() < 0.95
    assert (free != expected).sum() <= 3


def test_a_limit_is_as_far_as_the_hit_may_be(pair: Pair) -> None:
    origin, direction = rays(4)
    hierarchy, _ = pair
    found = hierarchy.intersect(origin, direction, QueryStats())
    some = np.concatenate([np.flatnonzero((found.triangle >= 0) == met)[:50] for met in (0, 1)])
    for share, beyond in ((1 + 1e-6, False), (1 - 1e-6, True)):
        for number in some:
            ray = origin[:, number, None], direction[:, number, None]
            limit = min(float(found.t[number]), 1e30) * share
            free = hierarchy.unoccluded(*ray, limit, QueryStats())
            assert free.tolist() == [found.triangle[number] < 0 or beyond]


def test_one_origin_serves_all_rays(pair: Pair) -> None:
    _, direction = rays(5)
    eye = np.array([[0.1], [0.2], [2]], np.float32)
    hierarchy, _ = pair
    one, each = (
        hierarchy.intersect(origin, direction, QueryStats())
        for origin in (eye, np.repeat(eye, N, axis=1))
    )
    np.testing.assert_array_equal(one.triangle, each.triangle)
    np.testing.assert_array_equal(one.u, each.u)


def test_tests_are_counted_for_both_kinds_of_query() -> None:
    # Two triangles, each in a leaf of its own: a root that all rays are tested with, and two children for some.
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [5, 0, 0], [5, 1, 0]])
    hierarchy, _ = both(square, np.array([[0, 1, 2], [3, 4, 5]]), leaf_size=1)
    x = np.array([0.9, -5.0], np.float32)
    origin = np.stack((x, np.full(2, -0.5, np.float32), np.ones(2, np.float32)))
    down = np.repeat(np.array([[0], [0], [-1]], np.float32), 2, axis=1)
    stats = QueryStats()
    hierarchy.intersect(origin, down, stats)
    # The first ray: the root, both children, and the triangle of the one whose box it meets. The second: the root.
    assert (stats.box_tests, stats.triangle_tests) == (4, 1)
    hierarchy.unoccluded(origin, down, 1e30, stats)
    assert (stats.box_tests, stats.triangle_tests) == (8, 2)
    assert stats.seconds == 0


def test_nothing_is_asked_where_there_is_nothing() -> None:
    hierarchy, _ = both(np.zeros((0, 3)), np.zeros((0, 3), int))
    origin, direction = rays(6)
    assert (hierarchy.intersect(origin, direction, QueryStats()).triangle == -1).all()
    assert hierarchy.unoccluded(origin, direction, 1.0, QueryStats()).all()
    none = np.zeros((3, 0), np.float32)
    assert hierarchy.intersect(none, none, QueryStats()).triangle.shape == (0,)


def _returning(**replaced: object) -> HierarchyAccelerator:
    changed = {name: (lambda *_, value=value: value) for name, value in replaced.items()}
    mesh = shapes.sphere(1, 8)
    return HierarchyAccelerator(
        mesh.vertices.astype(np.float32), mesh.triangles.astype(np.int32), functions(**changed), 4
    )


@pytest.mark.parametrize(
    ("replaced", "said"),
    [
        ({"traverse": (np.full(N, 10**6),) * 4}, "expected -1, or one of 0 to "),
        ({"traverse": (np.full(N, -2),) * 4}, "returned triangles from -2"),
    ],
)
def test_what_breaks_the_contract_is_said(replaced: dict[str, object], said: str) -> None:
    with pytest.raises(EffectError, match=said):
        _returning(**replaced).intersect(*rays(7), QueryStats())
