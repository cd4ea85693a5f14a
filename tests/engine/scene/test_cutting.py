"""Large triangles are cut beside small things, without a crack and without a change in what they carry."""

from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine import shapes
from course.engine.core.accelerator import QueryStats
from course.engine.core.ray_offset import OFFSET
from course.engine.core.types import Floats32
from course.engine.formats.meshes import transforms
from course.engine.scene.building import cutting
from course.engine.scene.building.cutting import cut
from course.engine.scene.building.triangles import NEAR, SmallThings
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.painting import Paint
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface

RATIO = 64.0
SIZES = (1e-4, 1e-7, 1e-10)


def thing(size: float, at: tuple[float, float, float] = (0, 0, 0)) -> SmallThings:
    middle = np.array([at])
    return SmallThings(middle - size / 2, middle + size / 2, np.array([size]))


def moved(mesh: Mesh, *steps: NDArray[np.float64]) -> Mesh:
    return transforms.apply(mesh, transforms.compose(list(steps)))


TURN = transforms.rotate((1.0, 2.0, 3.0), 33.0)[:3, :3]


def turned(mesh: Mesh) -> Mesh:
    return moved(mesh, transforms.rotate((1.0, 2.0, 3.0), 33.0))


def edges(parts: list[FullPart]) -> Counter[frozenset[Any]]:
    """How many triangles have each edge, its ends as float32 has them."""
    found: Counter[frozenset[Any]] = Counter()
    for part in parts:
        corners = (part.mesh.vertices.astype(np.float32) + np.float32(0))[part.mesh.triangles]
        for triangle in corners:
            places = [tuple(p.tolist()) for p in triangle]
            assert len(set(places)) == 3
            for k in range(3):
                found[frozenset((places[k], places[k - 1]))] += 1
    return found


def walls(size: float, turn: bool) -> list[FullPart]:
    """A closed room of six objects of a quad each, the floor's middle beside the origin."""
    room = shapes.box((2.0, 2.0, 2.0))
    parts = []
    for wall in range(6):
        triangles = room.triangles[2 * wall : 2 * wall + 2]
        mesh = moved(
            Mesh(room.vertices, triangles),
            transforms.translate(np.array([0.31, 1 - size / 3, 0.17])),
        )
        parts.append(FullPart(turned(mesh) if turn else mesh, wall))
    return parts


@pytest.mark.parametrize("turn", [False, True])
@pytest.mark.parametrize("size", SIZES)
def test_every_edge_of_a_closed_room_still_belongs_to_two_triangles(
    size: float, turn: bool
) -> None:
    whole = walls(size, turn)
    parts = cut(whole, thing(size), RATIO)
    assert sum(len(part.mesh.triangles) for part in parts) > 12 + 10 * np.log2(1 / size)
    assert set(edges(parts).values()) == {2}
    for before, after in zip(whole, parts, strict=True):
        assert area(after.mesh) == pytest.approx(area(before.mesh), rel=1e-12)


def test_a_fine_neighbour_is_cut_along_only_where_it_has_to_be() -> None:
    # A strip of many triangles whose edge is in the floor's: some of them have to follow the cuts.
    floor = FullPart(Mesh(np.array([[0, 0, 1.0], [1, 0, 0], [-1, 0, 0]]), np.array([[0, 1, 2]])), 0)
    fan = np.linspace(-0.5, 0.5, 200)
    vertices = np.array([[-1, 0, 0], [1, 0, 0], *([x, 0.2, -0.1] for x in fan)])
    triangles = [[0, 1, 2], *([1, 3 + k, 2 + k] for k in range(199))]
    wall = FullPart(Mesh(vertices, np.array(triangles)), 1)
    parts = cut([floor, wall], thing(1e-5), RATIO)
    before, after = edges([floor, wall]), edges(parts)
    # Open edges are as long as they were, and so no cut has a triangle on one side alone.
    assert open_length(after) == pytest.approx(open_length(before), rel=1e-6)
    assert 200 < len(parts[1].mesh.triangles) < 800


def open_length(counts: Counter[frozenset[Any]]) -> float:
    ends = [np.array(list(edge)) for edge, count in counts.items() if count == 1]
    return float(sum(np.linalg.norm(p[0] - p[1]) for p in ends))


def area(mesh: Mesh) -> float:
    p = mesh.vertices[mesh.triangles]
    return float(np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2)


@pytest.mark.parametrize("size", SIZES)
def test_offsets_shrink_with_the_distance_from_what_is_small(size: float) -> None:
    parts = cut(walls(size, True), thing(size), RATIO)
    for part in parts:
        p = part.mesh.vertices[part.mesh.triangles]
        low, high = p.min(axis=1), p.max(axis=1)
        apart = np.maximum(np.maximum(low, -high).max(axis=1), size)
        reach = np.abs(p).max(axis=(1, 2))
        assert (reach <= np.maximum(RATIO, NEAR) * apart * (1 + 1e-9)).all()
    surface = build_surface(parts)
    assert surface.triangles.planes[:, 6].min() <= OFFSET * RATIO * size


def test_what_corners_carry_is_interpolated_as_before() -> None:
    rng = np.random.default_rng(1)
    flat = Mesh(
        np.array([[1, 0, 1.0], [1, 0, -1], [-1, 0, -1], [-1, 0, 1]]),
        np.array([[0, 1, 2], [0, 2, 3]]),
    )
    normals = rng.normal(size=(4, 3)) + np.array([0, 3.0, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    uv, painted = rng.random((4, 2)), rng.random((2, 3, 3))
    mesh = turned(Mesh(flat.vertices, flat.triangles, normals, uv))
    part = FullPart(mesh, 0, paint=Paint(painted, lambda *_: np.zeros((3, 1), np.float32)))
    (after,) = cut([part], thing(1e-5), RATIO)
    pieces = after.mesh
    assert pieces.normals is not None
    assert pieces.uv is not None
    assert mesh.normals is not None
    assert mesh.uv is not None
    assert after.paint is not None
    assert len(after.paint.corners) == len(pieces.triangles) > 50
    # Each piece's middle, found again in the quad: by its two edges in the first triangle and in the second.
    weights = rng.dirichlet((1, 1, 1), len(pieces.triangles))
    at = np.einsum("tk,tkc->tc", weights, pieces.vertices[pieces.triangles])
    for parent in range(2):
        corners = mesh.vertices[mesh.triangles[parent]]
        frame = np.stack((corners[1] - corners[0], corners[2] - corners[0]), axis=1)
        u, v = np.linalg.lstsq(frame, (at - corners[0]).T, rcond=None)[0]
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        assert inside.sum() > 20
        w = np.stack((1 - u - v, u, v), axis=1)[inside]
        own = pieces.triangles[inside], weights[inside]
        for before, now in ((mesh.normals, pieces.normals), (mesh.uv, pieces.uv)):
            expected = w @ before[mesh.triangles[parent]]
            found = np.einsum("tk,tkc->tc", own[1], now[own[0]])
            assert np.allclose(found, expected, rtol=0, atol=1e-13)
        found = np.einsum("tk,tkc->tc", own[1], after.paint.corners[inside])
        assert np.allclose(found, w @ painted[parent], rtol=0, atol=1e-13)


def test_the_same_normal_at_all_corners_stays_the_same_to_the_bit() -> None:
    normal = np.array([0.1, 0.7, 0.3])
    normal /= np.linalg.norm(normal)
    flat = shapes.quad(2.0, 2.0)
    mesh = Mesh(flat.vertices, flat.triangles, np.tile(normal, (4, 1)), flat.uv)
    (after,) = cut([FullPart(mesh, 0)], thing(1e-6), RATIO)
    assert after.mesh.normals is not None
    assert (after.mesh.normals == normal).all()


def test_nothing_is_cut_where_nothing_is_small() -> None:
    whole = walls(0.5, True)
    assert all(a is b for a, b in zip(cut(whole, thing(0.5), RATIO), whole, strict=True))


def test_what_is_small_but_far_from_the_origin_asks_for_few_cuts() -> None:
    # No cut makes coordinates there smaller.
    parts = cut(walls(1e-9, False), thing(1e-9, (0.9, 0.0, 0.9)), RATIO)
    assert sum(len(part.mesh.triangles) for part in parts) < 200


@pytest.mark.parametrize(("width", "least", "most"), [(1e-9, 100, 8000), (1e-45, 2, 2)])
def test_needles_are_cut_across_and_not_along(width: float, least: int, most: int) -> None:
    # The thinner one has no area in float32.
    (after,) = cut([FullPart(shapes.quad(width, 2.0), 0)], thing(1e-9), RATIO)
    assert least <= len(after.mesh.triangles) <= most


def test_normals_that_cancel_in_the_middle_stay_finite() -> None:
    flat = shapes.quad(2.0, 2.0)
    normals = np.array([[0, 0.6, 0.8], [0, 0.6, -0.8], [0, -0.6, -0.8], [0, 0.6, 0.8]])
    mesh = Mesh(flat.vertices, flat.triangles, normals, flat.uv)
    (after,) = cut([FullPart(mesh, 0)], thing(1e-6), RATIO)
    assert after.mesh.normals is not None
    assert after.mesh.normals.any(axis=1).all()
    corner_normals = build_surface([after]).triangles.corner_normals
    assert corner_normals is not None
    assert np.isfinite(corner_normals).all()


def test_needles_over_each_other_take_no_more_pieces_than_are_of_use() -> None:
    # A disk squeezed to a line, the origin somewhere on it.
    disk = moved(
        shapes.disk(1.0, 9),
        transforms.rotate((0.0, 1.0, 0.0), 20.0),
        transforms.scale(np.array([1, 1, 1e-32])),
        transforms.translate(np.array([0.12345, 0, 0])),
    )
    (after,) = cut([FullPart(disk, 0)], thing(1e-12), RATIO)
    assert cutting.MOST < len(after.mesh.triangles) < 4 * cutting.MOST


def test_triangles_without_area_are_no_obstacle() -> None:
    line = Mesh(np.array([[-1, 0, 0], [1, 0, 0], [0.5, 0, 0]]), np.array([[0, 1, 2]]))
    smooth = Mesh(line.vertices, line.triangles, np.tile([0.0, 1, 0], (3, 1)))
    (after, _) = cut([FullPart(smooth, 0), FullPart(shapes.quad(2.0, 2.0), 0)], thing(1e-6), RATIO)
    assert after.mesh.normals is not None
    assert np.isfinite(after.mesh.normals).all()
    assert len(build_surface([after]).triangles.planes) == 0


@pytest.mark.parametrize("turn", [False, True])
@pytest.mark.parametrize("size", SIZES)
def test_no_ray_slips_through_the_cuts(size: float, turn: bool) -> None:
    # From above the floor, which is the closer the smaller the thing is, to points on all edges.
    scale = np.diag([*(3 * [2.0 ** np.round(-np.log2(size) / 2)]), 1.0])
    parts = [
        replace(part, mesh=moved(part.mesh, scale))
        for part in cut(walls(size, turn), thing(size), RATIO)
    ]
    surface = build_surface(parts)
    p, e1, e2 = (
        rows.astype(np.float64) for rows in (surface.triangles.planes[:, :3], *sides(surface))
    )
    share = np.random.default_rng(2).uniform(0.05, 0.95, (40, 1, 1))
    ways = (p + share * e1, p + share * e2, p + e1 + share * (e2 - e1))
    aims = np.concatenate([way.reshape(-1, 3) for way in ways]).T
    up = np.array([[0.0], [1.0], [0.0]])
    up = transforms.rotate((1.0, 2.0, 3.0), 33.0)[:3, :3] @ up if turn else up
    origin = (up * size * scale[0, 0]).astype(np.float32)
    direction = aims - origin
    direction /= np.sqrt((direction * direction).sum(axis=0))
    if turn:
        # The corners of a plane that is askew are rounded out of it: seen so flatly it is in front of itself.
        direction = direction[:, np.abs((up * direction).sum(axis=0)) > 1e-5]
    assert direction.shape[1] > 10_000
    hits = surface.accelerator.intersect(origin, direction.astype(np.float32), QueryStats(), None)
    assert (hits.triangle >= 0).all()


def sides(surface: FullSurface) -> tuple[Floats32, Floats32]:
    """e1 and e2 of all triangles."""
    return surface.triangles.edges[:, :3], surface.triangles.edges[:, 3:6]


def planks(rng: np.random.Generator, turn: bool) -> list[FullPart]:
    """A closed box 1 : 1 : 1000, four of its sides fans of needles or caps, in an object each, moved off the origin."""
    z = np.array([-1.0, 1.0])
    ring = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * 1e-3
    vertices = [[x, y, b] for b in z for x, y in ring]
    faces = [[[0, 3, 2], [0, 2, 1]], [[4, 5, 6], [4, 6, 7]]]
    for k in range(4):
        a, b = k, (k + 1) % 4
        middle = len(vertices)
        share = rng.uniform(0.1, 0.9, 2)
        at = np.array(vertices[a]) + share[0] * (np.array(vertices[b]) - vertices[a])
        vertices.append([*at[:2], 2 * share[1] - 1])
        around = [a, b, b + 4, a + 4]
        faces.append([[around[j], around[(j + 1) % 4], middle] for j in range(4)])
    at = np.array(vertices) + np.array([0.1, 0.05, 0])
    parts = [FullPart(Mesh(at, np.array(side)), number) for number, side in enumerate(faces)]
    return [replace(part, mesh=turned(part.mesh)) if turn else part for part in parts]


@pytest.mark.parametrize("turn", [False, True])
@pytest.mark.parametrize("size", [1e-4, 1e-6])
def test_every_edge_of_a_closed_rod_of_thin_triangles_still_belongs_to_two(
    size: float, turn: bool
) -> None:
    whole = planks(np.random.default_rng(4), turn)
    at = np.array([[0.1, 0.05, 0.3]]) @ (TURN.T if turn else np.eye(3))
    things = SmallThings(at - size / 2, at + size / 2, np.array([size]))
    parts = cut(whole, things, 1024.0)
    count = sum(len(part.mesh.triangles) for part in parts)
    assert 100 < count < 5000
    assert set(edges(parts).values()) == {2}
    for before, after in zip(whole, parts, strict=True):
        assert area(after.mesh) == pytest.approx(area(before.mesh), rel=1e-9)
        normals = [
            np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
            for p in (mesh.vertices[mesh.triangles] for mesh in (before.mesh, after.mesh))
        ]
        # All look to the same side as before.
        assert (normals[1] @ normals[0].sum(axis=0) > 0).all()


def test_rays_leave_thin_triangles_from_close_by_where_something_small_is() -> None:
    size = 1e-2
    whole = planks(np.random.default_rng(4), True)
    things = thing(size, tuple(TURN @ (0.1, 0.05, 0)))
    assert build_surface(whole).triangles.planes[:, 6].max() > 2 * size / 512
    count = 0
    for part in cut(whole, things, 1024.0):
        p = part.mesh.vertices[part.mesh.triangles]
        low, high = things.low - size, things.high + size
        beside = ((p.min(axis=1) < high) & (p.max(axis=1) > low)).all(axis=1)
        count += int(beside.sum())
        offsets = build_surface([part]).triangles.planes[:, 6]
        assert (offsets[beside] <= 1.01 * 2 * size / 512).all()
    assert count > 4


def test_a_fan_of_needles_takes_few_pieces() -> None:
    # Halved again and again, they would take 90,000, and not be short enough then.
    x = np.linspace(-0.15, 0.15, 9)
    corners = np.array([(0, 0, -750.0), *((a, 0, 750.0) for a in x)]) / 750
    fan = FullPart(Mesh(corners, np.array([(0, k + 1, k + 2) for k in range(8)])), 0)
    (after,) = cut([fan], thing(1e-4), 1024.0)
    assert 50 < len(after.mesh.triangles) < 3000
