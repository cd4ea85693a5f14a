"""Groups of a light's triangles: each is chosen as often as its weight says, and rather where that pays.

Numbers are drawn with fixed seeds. A mean of N draws is held within 6.7 of its standard errors: each of the 600 of this
file fails by chance once in 5 * 10^10 draws of other seeds. Other limits are far from what they hold.
"""

import math

import numpy as np
import pytest

from course.engine import shapes
from course.engine.core.types import Floats32, Floats64
from course.engine.shapes.mesh import Mesh
from course.engine.terms.lights.mesh_groups import GROUPS, TRUST
from course.engine.terms.lights.mesh_light import MeshLight, areas
from tests.engine.terms.lights.mesh_lamps import BALL, KNOT, around, lamp, moved, without
from tests.lengths import fewer

LAMPS = {"ball": BALL, "knot": KNOT, "box": shapes.box(), "open": without(BALL, *range(400))}
BELOW_ONE = np.nextafter(np.float32(1), np.float32(0))


def chosen(light: MeshLight, points: Floats32, number: Floats32) -> tuple[np.ndarray, Floats64]:
    """Triangles and weights."""
    place, weight = light.groups.choose(points, number)
    found = np.searchsorted(light.groups.shares, place, side="right")
    return light.groups.triangle[found], weight.astype(np.float64)


def steps(n: int) -> Floats32:
    """Numbers from 0 to 1, in equal steps."""
    return ((np.arange(n) + 0.5) / n).astype(np.float32)


def middles(light: MeshLight) -> Floats64:
    """Of the triangles, (T, 3)."""
    corner, edges = light.planes[:, :3].astype(np.float64), light.edges.astype(np.float64)
    return corner + (edges[:, :3] + edges[:, 3:6]) / 3


# ---------------------------------------------------------------- without bias


@fewer
@pytest.mark.parametrize("distance", [0.01, 0.31, 0.7, 50])
@pytest.mark.parametrize("name", LAMPS)
def test_what_is_chosen_by_its_weight_is_uniform_by_area(name: str, distance: float) -> None:
    """From within, from near and from far: the mean of functions of the place is that over the surface."""
    light, n = lamp(LAMPS[name]), 100_000
    area = areas(light.edges)
    place = middles(light)
    functions = np.column_stack(
        (np.ones(len(area)), place, place**2, light.planes[:, 3:6], np.abs(light.planes[:, 3:6]))
    )
    expected = area @ functions / area.sum()
    number = np.random.default_rng(2).random(n, np.float32)
    for point in around(3, distance, 1).T:
        triangle, weight = chosen(light, np.repeat(point[:, None], n, axis=1), number)
        values = weight[:, None] * functions[triangle]
        error = values.std(axis=0) / math.sqrt(n)
        assert (np.abs(values.mean(axis=0) - expected) < 6.7 * error + 1e-6).all()


def test_every_triangle_of_a_group_is_chosen_by_its_area() -> None:
    """From one point, for all numbers in equal steps: no chance, but for the steps."""
    light, n = lamp(KNOT), 1_000_000
    area = areas(light.edges)
    triangle, weight = chosen(light, np.repeat(around(1, 0.6, 3), n, axis=1), steps(n))
    share = np.bincount(triangle, weight, len(area)) / n
    # At most two steps at the ends of a triangle's stretch, each a weight's worth.
    assert (np.abs(share - area / area.sum()) < 2.5 * weight.max() / n).all()
    assert len(np.unique(weight.round(6))) == GROUPS


def test_numbers_go_through_the_triangles_in_order() -> None:
    """Near numbers give near places: what a sampler spreads evenly stays spread."""
    light, n = lamp(KNOT), 10_000
    number = np.linspace(0, BELOW_ONE, n, dtype=np.float32)
    place, _ = light.groups.choose(np.repeat(around(1, 0.6, 4), n, axis=1), number)
    assert (np.diff(place) >= 0).all()


# ---------------------------------------------------------------- where it pays


@pytest.mark.parametrize(
    ("name", "before", "share"), [("ball", 5 / 3, 0.2), ("box", 1.0, 0.1), ("knot", 1.4, 0.5)]
)
def test_far_away_the_estimates_scatter_less(name: str, before: float, share: float) -> None:
    """Of the light that fronts send, relative variance from one direction: by area of a ball it is 5 / 3."""
    light, n = lamp(LAMPS[name]), 100_000
    number = np.random.default_rng(5).random(n, np.float32)
    normals = light.planes[:, 3:6].astype(np.float64)
    area = areas(light.edges)
    for point in around(3, 30, 6).T:
        sent = np.maximum(normals @ (point / np.linalg.norm(point)), 0)
        mean, square = area @ sent / area.sum(), area @ sent**2 / area.sum()
        by_area = square / mean**2 - 1
        triangle, weight = chosen(light, np.repeat(point[:, None], n, axis=1), number)
        values = weight * sent[triangle]
        assert by_area > before * 0.99
        assert values.var() / mean**2 < share * by_area


@pytest.mark.parametrize("x", [0, 5])
def test_of_a_ball_nine_places_in_ten_face_the_point(x: float) -> None:
    light, n = lamp(moved(BALL, 1, x)), 20_000
    points = around(n, 3, 7)
    points[0] += np.float32(x)
    triangle, _ = chosen(light, points, np.random.default_rng(8).random(n, np.float32))
    to_point = points.T - middles(light)[triangle]
    assert ((light.planes[triangle, 3:6] * to_point).sum(axis=1) > 0).mean() > 0.9


def test_near_a_long_lamp_places_are_near() -> None:
    """The density follows 1 / d^2: of a strip as long as 40 distances most places lie on 4 of them."""
    strip, n = lamp(Mesh(*_strip(400))), 20_000
    point = np.array([[0.0], [0.1], [0.0]], np.float32)
    number = np.random.default_rng(9).random(n, np.float32)
    triangle, _ = chosen(strip, np.repeat(point, n, axis=1), number)
    assert (np.abs(middles(strip)[triangle, 0]) < 0.2).mean() > 0.5


def _strip(count: int) -> tuple[np.ndarray, np.ndarray]:
    """A level strip from x = -2 to 2, a hundredth wide, of so many pieces."""
    x = np.linspace(-2, 2, count + 1)
    vertices = np.stack([np.stack((x, 0 * x, 0 * x + z), axis=1) for z in (-0.005, 0.005)], axis=1)
    first = 2 * np.arange(count)
    triangles = np.stack((first, first + 1, first + 2, first + 2, first + 1, first + 3), axis=1)
    return vertices.reshape(-1, 3), triangles.reshape(-1, 3)


# ---------------------------------------------------------------- what hides its back


@pytest.mark.parametrize(
    ("mesh", "trust"),
    [
        (BALL, TRUST),
        (KNOT, TRUST),
        (shapes.box(), TRUST),
        (shapes.box((1, 0.001, 1)), TRUST),
        (shapes.cylinder(), TRUST),
        (shapes.cone(), TRUST),
        (shapes.torus(1, 0.2, 12, 8), TRUST),
        # So small and so far off that coordinates have 10 bits of it.
        (moved(BALL, 1e-4 / 0.3, 1.0), TRUST),
        (moved(BALL, 1, turned=True), -TRUST),
        (shapes.quad(), 0),
        (shapes.disk(), 0),
        (without(BALL, *range(400)), 0),
        (without(BALL, 700, 701), 0),
        # A tube without ends, and plates that face away from each other: their normals cancel as well.
        (without(shapes.box(), 0, 1, 2, 3), 0),
        (without(shapes.box(), *range(4, 12)), 0),
    ],
)
def test_only_closed_bodies_are_trusted_to_hide_their_backs(mesh: Mesh, trust: float) -> None:
    assert lamp(mesh).groups.trust == trust


def test_a_body_that_is_no_longer_oriented_is_not_trusted() -> None:
    box = shapes.box()
    triangles = np.array(box.triangles)
    triangles[:2] = triangles[:2, ::-1]
    assert lamp(Mesh(box.vertices, triangles)).groups.trust == 0


def test_backs_are_chosen_too() -> None:
    """Of a box, straight above it: the lower side as often as TRUST says, and with as large a weight."""
    light, number = lamp(shapes.box()), steps(100_000)
    point = np.array([[0.0], [900.0], [0.0]], np.float32)
    triangle, weight = chosen(light, point.repeat(len(number), axis=1), number)
    down = light.planes[triangle, 4] < -0.5
    up = light.planes[triangle, 4] > 0.5
    odds = (1 - TRUST) / (1 + TRUST)
    assert down.sum() / up.sum() == pytest.approx(odds, rel=0.02)
    assert weight[up].max() / weight[down].min() == pytest.approx(odds, rel=0.02)


# ---------------------------------------------------------------- extremes


@pytest.mark.parametrize("scale", [1e-20, 1e-6, 1, 3])
@pytest.mark.parametrize("name", LAMPS)
def test_everything_is_finite_everywhere(name: str, scale: float) -> None:
    light = lamp(moved(LAMPS[name], scale))
    corners = light.planes[:100, :3].T
    axes = np.array([[0, 0, 0], [1, 0, 0], [0, scale / 2, 0], [1, 1, 1]], np.float32).T
    points = np.ascontiguousarray(np.column_stack((corners, axes)))
    # A sampler that somebody has written may bring 1.
    for number in (0, 0.5, BELOW_ONE, 1):
        numbers = np.full(points.shape[1], number, np.float32)
        place, weight = light.groups.choose(points, numbers)
        assert place.min() >= 0
        assert place.max() < 1
        assert weight.min() > 0
        assert np.isfinite(weight).all()


def test_triangles_that_are_alike_make_one_group() -> None:
    """Nothing to divide them by: they lie upon each other."""
    light = lamp(Mesh(np.eye(3), np.array([[0, 1, 2]] * 5)))
    assert len(light.groups.share) == 1
    place, weight = light.groups.choose(around(100, 1, 1), steps(100))
    assert weight == pytest.approx(1)
    assert place == pytest.approx(steps(100), abs=1e-6)
