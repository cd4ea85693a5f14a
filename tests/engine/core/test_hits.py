"""Where rays meet the surface: on the triangle, with normals that face the ray, and smooth where the mesh should be."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine import shapes
from course.engine.core.accelerator import QueryStats
from course.engine.core.hits import Hits
from course.engine.core.ray_offset import bulge
from course.engine.core.triangles import Triangles
from course.engine.formats.meshes import transforms
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface
from tests.conftest import MakeScene, PixelRays
from tests.lengths import fewer

Array = NDArray[np.float64]
ULP = 2.0**-23

TURN = transforms.rotate(np.array([1.0, 2.0, 3.0]), 33.0)
CORNER = transforms.translate(np.array([0.9, -0.7, 0.8]))
MESHES = {
    "sphere": shapes.sphere(1, 64),
    "small sphere off centre": transforms.apply(shapes.sphere(0.01, 32), CORNER),
    "box": transforms.apply(shapes.box((2, 1, 0.5)), TURN),
    "torus knot": shapes.torus_knot(2, 3, 0.8, 0.2, 200, 16),
    "cylinder of slivers": transforms.apply(shapes.cylinder(0.5, 1, 4096), TURN),
    "cone of slivers": transforms.apply(shapes.cone(0.5, 1, 1024), TURN),
}


AWAY = 2.0
"""How far rays start from what they are aimed at."""


def aimed(mesh: Mesh, n: int, distance: float = AWAY) -> tuple[NDArray[np.float32], Any]:
    """Rays that start a distance from uniform points of random triangles and aim at them, (3, n) float32 each."""
    rng = np.random.default_rng(7)
    p = mesh.vertices[mesh.triangles[rng.integers(len(mesh.triangles), size=n)]]
    weights = rng.dirichlet((1, 1, 1), n)
    target = (p * weights[:, :, None]).sum(axis=1).T
    away = rng.normal(size=(3, n))
    origin = (target + distance * away / np.linalg.norm(away, axis=0)).astype(np.float32)
    direction = target - origin
    return origin, (direction / np.linalg.norm(direction, axis=0)).astype(np.float32)


def cast(surface: FullSurface, origin: Any, direction: Any) -> Hits:
    found = surface.accelerator.intersect(origin, direction, QueryStats())
    return surface.hits(found, direction)


@pytest.fixture(params=MESHES)
def met(request: pytest.FixtureRequest) -> tuple[Mesh, FullSurface, Hits, Any, Any]:
    """A mesh, its surface, hits on it, and the rays that found them."""
    mesh = MESHES[request.param]
    surface = build_surface([FullPart(mesh, 3)])
    origin, direction = aimed(mesh, 20000)
    hits = cast(surface, origin, direction)
    assert hits.size > 19000
    if hits.ray is not None:
        origin, direction = origin[:, hits.ray], direction[:, hits.ray]
    return mesh, surface, hits, origin, direction


Met = tuple[Mesh, FullSurface, Hits, Any, Any]


def corners(surface: FullSurface, hits: Hits) -> Array:
    """(3 corners, 3, n) float64 of the triangles that were hit."""
    p0 = surface.triangles.planes[hits.triangle, :3].T.astype(np.float64)
    e1, e2 = surface.triangles.edges[hits.triangle, :6].T.astype(np.float64).reshape(2, 3, -1)
    return np.stack((p0, p0 + e1, p0 + e2))


def test_hit_points_lie_on_their_triangles(met: Met) -> None:
    _, surface, hits, _, _ = met
    p = corners(surface, hits)
    normal = np.cross(p[1] - p[0], p[2] - p[0], axis=0)
    normal /= np.linalg.norm(normal, axis=0)
    height = np.abs(((hits.p - p[0]) * normal).sum(axis=0))
    # Two products and two sums, each rounded once by half a unit of the largest coordinate, and the edges before.
    assert (height <= 2 * ULP * np.abs(p).max(axis=(0, 1))).all()


def test_hit_points_are_where_the_ray_says(met: Met) -> None:
    _, surface, hits, origin, direction = met
    there = origin.astype(np.float64) + hits.t.astype(np.float64) * direction
    distance = np.linalg.norm(hits.p - there, axis=0)
    offset = surface.triangles.planes[hits.triangle, 6]
    # Next to an edge they are moved by two offsets, in a corner from both its edges, further where that is acute.
    # Embree's t is off by as much as the offset is there for, over the cosine, and by its own rounding. A barycentric
    # is a product of the triangle's longest edge, of the distance of its corners and of the direction, rounded, over
    # twice the area: along a thin triangle it errs.
    cosine = np.abs((direction * hits.ng).sum(axis=0))
    steep = cosine > 0.1
    p = corners(surface, hits)
    twice_area = np.linalg.norm(np.cross(p[1] - p[0], p[2] - p[0], axis=0), axis=0)
    longest = np.linalg.norm(p - np.roll(p, 1, axis=0), axis=1).max(axis=0)
    along = 2.0**-24 * longest**2 * (longest + 2 * AWAY) / twice_area
    allowed = 6 * offset + (offset + 1.5 * along) / cosine + 10 * 2 * ULP
    assert (distance[steep] <= allowed[steep]).all()
    assert steep.mean() > 0.8


def test_points_inside_a_triangle_are_exact_and_only_those_at_edges_are_moved(met: Met) -> None:
    _, surface, hits, _, _ = met
    p = corners(surface, hits)
    u, v = hits.u.astype(np.float64), hits.v.astype(np.float64)
    barycentric = np.stack((1 - u - v, u, v))
    inset = surface.triangles.inset[hits.triangle].T
    free = (barycentric > inset + 1e-6).all(axis=0)
    exact = (p * barycentric[:, None, :]).sum(axis=0)
    error = np.abs(hits.p - exact).max(axis=0)
    assert (error[free] <= 2 * ULP * np.abs(p).max(axis=(0, 1))[free]).all()


def test_geometric_normals_are_unit_and_face_the_ray(met: Met) -> None:
    mesh, surface, hits, _, direction = met
    assert np.abs(np.linalg.norm(hits.ng.astype(float), axis=0) - 1).max() < 1e-6
    assert ((hits.ng * direction).sum(axis=0) <= 0).all()
    p = corners(surface, hits)
    outward = np.cross(p[1] - p[0], p[2] - p[0], axis=0)
    outward /= np.linalg.norm(outward, axis=0)
    assert np.abs((outward * hits.ng).sum(axis=0) - hits.side).max() < 1e-5
    assert np.array_equal(hits.entering, hits.side == 1)
    if mesh is not MESHES["torus knot"]:
        # Seen from outside, a closed convex mesh shows its front; rays that begin inside it see the back.
        assert 0.9 < hits.entering.mean() <= 1


def interpolated(mesh: Mesh, hits: Hits) -> Array:
    """Shading normals (3, n) in float64."""
    assert mesh.normals is not None
    n = mesh.normals[mesh.triangles[hits.triangle]]
    u, v = hits.u.astype(float), hits.v.astype(float)
    smooth = n[:, 0] * (1 - u - v)[:, None] + n[:, 1] * u[:, None] + n[:, 2] * v[:, None]
    return np.asarray((smooth / np.linalg.norm(smooth, axis=1, keepdims=True)).T * hits.side)


def test_shading_normals_interpolate_and_face_the_ray(met: Met) -> None:
    mesh, _, hits, _, direction = met
    assert np.abs(np.linalg.norm(hits.ns.astype(float), axis=0) - 1).max() < 1e-6
    facing = (hits.ns.astype(float) * direction).sum(axis=0)
    assert facing.max() < 1e-6
    smooth = interpolated(mesh, hits)
    as_it_is = (smooth * direction).sum(axis=0) < -1e-6
    assert as_it_is.mean() > 0.9
    assert np.abs(hits.ns - smooth)[:, as_it_is].max() < 1e-6
    # The others looked away from the viewer, and were turned until they are just in sight.
    assert np.abs(facing[~as_it_is]).max(initial=0) < 2e-6


def test_shading_normals_may_look_away_from_the_ray() -> None:
    mesh = shapes.sphere(1, 8)
    origin, direction = aimed(mesh, 20000)
    glass = np.array([False, True])
    plain, bent = (
        cast(build_surface([FullPart(mesh, material)], turned=glass), origin, direction)
        for material in (0, 1)
    )
    assert np.abs(plain.ns - interpolated(mesh, plain)).max() < 1e-6
    assert ((plain.ns * plain.direction).sum(axis=0) > 0.01).sum() > 100
    # Of the materials that are named they are bent after all.
    assert np.array_equal(bent.ns, cast(build_surface([FullPart(mesh, 1)]), origin, direction).ns)
    assert (bent.ns * bent.direction).sum(axis=0).max() < 1e-6


def test_hits_carry_material_ray_and_distance() -> None:
    near, far = (
        shapes.quad(2, 2),
        transforms.apply(shapes.quad(2, 2), transforms.translate([0, -1, 0])),
    )
    surface = build_surface([FullPart(near, 5), FullPart(far, 9)])
    origin = np.array([[0.1, 0.2, 5, 0.3], [2, 2, 2, -0.5], [0.1, 0.1, 0.1, 0.1]], np.float32)
    direction = np.repeat(np.array([[0], [-1], [0]], np.float32), 4, axis=1)
    before = direction.copy()
    hits = cast(surface, origin, direction)
    assert hits.ray is not None
    assert hits.ray.tolist() == [0, 1, 3]
    assert hits.material.tolist() == [5, 5, 9]
    assert np.allclose(hits.t, [2, 2, 0.5])
    assert np.array_equal(direction, before)
    everything = cast(surface, origin[:, :2].copy(), direction[:, :2].copy())
    assert everything.ray is None
    nothing = cast(surface, origin[:, 2:3].copy(), direction[:, 2:3].copy())
    assert (nothing.size, nothing.p.shape) == (0, (3, 0))


def test_flat_meshes_shade_with_their_facets() -> None:
    ball = shapes.sphere(1, 12)
    for parts in (
        [FullPart(Mesh(ball.vertices, ball.triangles), 0)],
        # Beside a smooth mesh, whose tables it shares.
        [
            FullPart(Mesh(ball.vertices, ball.triangles), 0),
            FullPart(transforms.apply(ball, CORNER), 1),
        ],
    ):
        surface = build_surface(parts)
        hits = cast(surface, *aimed(ball, 2000))
        flat = hits.material == 0
        assert np.abs(hits.ns - hits.ng)[:, flat].max() < 1e-6
        if len(parts) == 1:
            assert surface.triangles.bulge is None
        else:
            assert not bulge(surface.triangles, hits, np.flatnonzero(flat)).any()


def test_the_bulge_is_the_height_of_the_round_surface() -> None:
    for segments in (16, 64):
        ball = shapes.sphere(1, segments)
        surface = build_surface([FullPart(ball, 0)])
        hits = cast(surface, *aimed(ball, 20000, 1.5))
        height = bulge(surface.triangles, hits, np.arange(hits.size))
        missing = 1 - np.linalg.norm(hits.p.astype(float), axis=0)
        front = hits.entering
        sagitta = (2 * np.pi / segments) ** 2 / 8
        # A parabola instead of a circle: off by the square of the sagitta; a unit or two of float32 beside.
        assert np.abs(height - missing)[front].max() < 2 * sagitta**2 + 4 * ULP
        assert height.max() > 0.9 * sagitta
        # From inside, the round surface lies behind the facets.
        assert not height[~front].any()
        assert (~front).any()


def lit_ball(
    make_scene: MakeScene, segments: int, light: dict[str, Any], **thing: Any
) -> tuple[Scene, NDArray[np.float32]]:
    ball = {"shape": "sphere", "material": "white", "segments": segments} | thing
    scene = make_scene(
        camera={"eye": [0, 0.3, 5], "look_at": [0, 0, 0], "vertical_fov": 24},
        film={"width": 96, "height": 96},
        sampler={"type": "regular", "samples": 1},
        materials={"white": {"color": 1}},
        objects=[ball],
        lights=[light],
    )
    return scene, render(scene).linear[..., 0]


def round_ball(scene: Scene, pixel_rays: PixelRays) -> tuple[Array, Array]:
    """Normals (3, H, W) of the unit sphere itself, and the cosine to the viewer; 0 where it is missed."""
    eye, d = pixel_rays(scene)
    b = np.tensordot(eye, d, 1)
    inside = b**2 - eye @ eye + 1
    t = -b - np.sqrt(np.maximum(inside, 0))
    normal = eye[:, None, None] + t * d
    return normal, np.where(inside > 0, -(normal * d).sum(axis=0), 0)


LIGHTS = [
    np.array([1.0, 0.2, 0.1]),
    np.array([0.3, 1.0, -0.5]),
    np.array([-1.0, 0.1, -0.6]),
    np.array([0.0, -0.7, 0.7]),
]


@fewer
@pytest.mark.parametrize("segments", [8, 16, 32, 64])
@pytest.mark.parametrize("towards", LIGHTS)
@pytest.mark.parametrize("kind", ["directional", "point"])
def test_a_coarse_smooth_ball_is_lit_like_a_round_one(
    make_scene: MakeScene, pixel_rays: PixelRays, segments: int, towards: Array, kind: str
) -> None:
    towards = towards / np.linalg.norm(towards)
    if kind == "directional":
        light = {"type": kind, "direction": (-towards).tolist(), "irradiance": np.pi}
    else:
        light = {"type": kind, "position": (30 * towards).tolist(), "intensity": 900 * np.pi}
    scene, found = lit_ball(make_scene, segments, light)
    normal, to_viewer = round_ball(scene, pixel_rays)
    cosine = np.tensordot(towards, normal, 1)
    expected = np.maximum(cosine, 0)
    if kind == "point":
        to_light = 30 * towards[:, None, None] - normal
        d = np.linalg.norm(to_light, axis=0)
        expected = 900 * np.maximum((to_light * normal).sum(axis=0), 0) / d**3
    # Within the silhouette of the coarse ball, too. There, a point of the facet differs from the one of the round
    # ball by up to the sagitta times the slant, and so does the normal.
    step = 2 * np.pi / segments
    seen = to_viewer > 0.3 + step / 2
    assert seen.sum() > 800
    error = np.abs(found - expected)[seen]
    assert error.max() < 0.75 * step**2 + 1e-4
    # No black teeth: wherever the round ball is lit by more than that bound, so is the coarse one.
    assert (found[seen & (expected > 0.75 * step**2)] > 0).all()
    # And no light on the far side.
    assert not found[seen & (cosine < -0.75 * step**2 - 0.04 * (kind == "point"))].any()


def test_without_the_bulge_a_coarse_ball_has_teeth(
    make_scene: MakeScene, pixel_rays: PixelRays, monkeypatch: pytest.MonkeyPatch
) -> None:
    from course.engine.core import direct
    from course.engine.render import which_loops

    def flat(_triangles: Triangles, _hits: Hits, which: NDArray[np.intp]) -> NDArray[np.float32]:
        return np.zeros(len(which), np.float32)

    monkeypatch.setattr(direct, "bulge", flat)
    monkeypatch.setattr(which_loops, "available", lambda: False)
    light = {"type": "directional", "direction": [-1, -0.2, -0.1], "irradiance": np.pi}
    scene, found = lit_ball(make_scene, 16, light)
    normal, to_viewer = round_ball(scene, pixel_rays)
    towards = np.array([1, 0.2, 0.1]) / np.linalg.norm([1, 0.2, 0.1])
    lit = (to_viewer > 0.5) & (np.tensordot(towards, normal, 1) > 0.75 * (2 * np.pi / 16) ** 2)
    assert (found[lit] == 0).any(), "the test above would notice"


@fewer
@pytest.mark.parametrize("segments", [8, 16, 32, 64])
@pytest.mark.parametrize("height", [0.99, 0.9, 0.5])
def test_the_bulge_leaks_no_light_through_a_wall(
    make_scene: MakeScene, segments: int, height: float
) -> None:
    # A ball sunk into a floor, the light beneath: just above the floor the round surface lies below it.
    wall = {"shape": "quad", "material": "white", "width": 20, "depth": 20}
    ball = {"shape": "sphere", "material": "white", "segments": segments}
    for x in (0.3, 2.5, 9.0):
        for y in (-3.0, -0.2, -0.01):
            scene = make_scene(
                camera={"eye": [0, 0.3, 4], "look_at": [0, 0.2, 0], "vertical_fov": 30},
                film={"width": 64, "height": 64},
                materials={"white": {}},
                objects=[ball | {"transform": [{"translate": [0, height, 0]}]}, wall],
                lights=[{"type": "point", "position": [x, y, 0.2], "intensity": 10}],
            )
            assert not render(scene).linear.any()


@pytest.mark.parametrize("segments", [3, 4, 8, 16, 64])
def test_a_smooth_shell_keeps_light_in_and_out(make_scene: MakeScene, segments: int) -> None:
    ball = {"shape": "sphere", "material": "white", "segments": segments}
    out = {"eye": [0, 1, 4], "look_at": [0, 0, 0], "vertical_fov": 40}
    within = {"eye": [0, 0, 0.1], "look_at": [1, 0.1, 0.3], "vertical_fov": 150}
    for camera, position in ((out, [0, 0, 0]), (out, [0.1, -0.2, 0.1]), (within, [3, 3, 3])):
        scene = make_scene(
            camera=camera,
            film={"width": 64, "height": 64},
            materials={"white": {}},
            objects=[ball],
            lights=[{"type": "point", "position": position, "intensity": 10}],
        )
        assert not render(scene, spp=16).linear.any()
