"""No ray meets the surface that it leaves, and no light gets through a closed one.

What is measured here, in the units of the compiled scene, whose half extent is 1:

- A hit point and Embree's own plane err by a few 2^-24 of the triangle's largest coordinate. Rays from OFFSET = 2^-19
  of it above the surface don't meet it again; from 2^-21 neither, from 2^-23 a few do, from 2^-25 every second one.
- The planes of long thin triangles are tilted by 2^-24 length / height. Of 37,000 grazing rays that leave a patch of
  strips 1000 : 1 away from the origin, 2229 meet it again with TILT = 1/8, 462 with 1/4, none with 1/2.
- Embree's robust mode loses no ray through an edge, and rays exactly through about 2 vertices in 1000.
- A sliver of 10^6 : 1 in general position is no longer flat with its neighbours: its corners, rounded to float32, turn
  it by 2 degrees. Rays that graze it then meet them, and rightly so; such slivers are tested in a plane y = 0.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import render
from course.engine import shapes
from course.engine.core import ray_offset
from course.engine.core.accelerator import QueryStats
from course.engine.core.hits import Hits
from course.engine.formats.meshes import transforms
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart, FullSurface, build_surface
from tests.conftest import MakeScene
from tests.lengths import fewer

Array = NDArray[np.float64]
STATS = QueryStats()

TURN = transforms.rotate(np.array([1.0, 2.0, 3.0]), 33.0)


def turned(mesh: Mesh) -> Mesh:
    return transforms.apply(mesh, TURN)


def tetrahedron() -> Mesh:
    """Edges at 70.5 degrees, the sharpest of the regular solids."""
    vertices = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float) / np.sqrt(3)
    return Mesh(vertices, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]))


def strips(ratio: float) -> Mesh:
    """A square of side 2 in the xz plane; 64 triangles across its middle are `ratio` times as long as high."""
    z = np.concatenate(([-1], (np.arange(33) - 16) * 2 / ratio, [1]))
    z = np.unique(np.clip(z, -1, 1))
    vertices = np.array([[x, 0, zz] for zz in z for x in (-1.0, 1.0)])
    rows = 2 * np.arange(len(z) - 1)[:, None, None]
    triangles = rows + np.array([[0, 2, 1], [1, 2, 3]])
    return Mesh(vertices, triangles.reshape(-1, 3))


def graded() -> Mesh:
    """A disk about the origin whose triangles shrink from 1 to 10^-6 towards the middle."""
    radius, around = 10.0 ** np.linspace(-6, 0, 25), np.arange(24) * np.pi / 12
    ring = np.stack((np.cos(around), 0 * around, -np.sin(around)), axis=1)
    vertices = np.concatenate(([[0.0, 0.0, 0.0]], (radius[:, None, None] * ring).reshape(-1, 3)))
    i, j = np.arange(24), (np.arange(24) + 1) % 24
    fan = np.stack((0 * i, 1 + i, 1 + j), axis=1)
    start = 24 * np.arange(24)[:, None] + 1
    a, b = start + i, start + j
    inner = np.stack((a, a + 24, b + 24, a, b + 24, b), axis=2).reshape(-1, 3)
    return Mesh(vertices, np.concatenate((fan, inner)))


CONVEX = {
    "sphere": shapes.sphere(1, 64),
    "fine sphere": shapes.sphere(1, 512),
    "small sphere off centre": transforms.apply(
        shapes.sphere(0.01, 64), transforms.translate(np.array([0.9, -0.7, 0.8]))
    ),
    "small sphere in the middle": shapes.sphere(0.001, 64),
    "box": turned(shapes.box((2, 1, 0.5))),
    "square": turned(shapes.quad(2, 2)),
    "disk": turned(shapes.disk(1, 256)),
    "cone": turned(shapes.cone(0.5, 1, 512)),
    "cylinder": turned(shapes.cylinder(0.5, 1, 1024)),
    "fine cylinder": turned(shapes.cylinder(0.5, 1, 4096)),
    "triangles of all sizes": turned(graded()),
    "slivers 1e6": strips(1e6),
    "short slivers off centre": transforms.apply(
        turned(strips(1e3)),
        transforms.translate(np.array([0.9, -0.7, 0.8])) @ transforms.scale(np.full(3, 0.02)),
    ),
    "slender box": turned(shapes.box((2, 1e-4, 0.004))),
} | {f"slivers 1e{k}": turned(strips(10.0**k)) for k in range(2, 6)}


def unit(rng: np.random.Generator, n: int) -> Array:
    d = rng.normal(size=(3, n))
    return d / np.linalg.norm(d, axis=0)


def cast(built: FullSurface, origin: Array, target: Array) -> Hits:
    start = origin.astype(np.float32)
    direction = target - start
    direction = (direction / np.linalg.norm(direction, axis=0)).astype(np.float32)
    return built.hits(built.accelerator.intersect(start, direction, STATS), direction)


def front_hits(mesh: Mesh, built: FullSurface, rng: np.random.Generator, n: int) -> Hits:
    """Hits, from outside, of rays at uniform points of random triangles."""
    p = mesh.vertices[mesh.triangles[rng.integers(len(mesh.triangles), size=n)]]
    target = (p * rng.dirichlet((1, 1, 1), n)[:, :, None]).sum(axis=1).T
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]).T
    away = unit(rng, n)
    away *= np.sign((away * normal).sum(axis=0))
    return cast(built, target + 3 * away, target)


def hemisphere(hits: Hits, rng: np.random.Generator, grazing: bool) -> NDArray[np.float32]:
    """A direction for each hit, all over the hemisphere, or 1e-6 .. 1 rad above the surface (uniform logarithm)."""
    ng = hits.ng.astype(np.float64)
    d = unit(rng, hits.size)
    if grazing:
        d -= (d * ng).sum(axis=0) * ng
        d /= np.linalg.norm(d, axis=0)
        d += ng * 10 ** rng.uniform(-6, 0, hits.size)
        d /= np.linalg.norm(d, axis=0)
    else:
        d *= np.sign((d * ng).sum(axis=0))
    return d.astype(np.float32)


def self_hits(mesh: Mesh, grazing: bool, n: int = 40000) -> tuple[int, int]:
    """How many rays that leave the front of a convex surface meet it again, and of how many."""
    built, rng = build_surface([FullPart(mesh, 0)]), np.random.default_rng(5)
    hits = front_hits(mesh, built, rng, n)
    d = hemisphere(hits, rng, grazing)
    # A grazing direction rounded to float32 may point below the surface, which it then rightly meets.
    fair = hits.entering & ((d.astype(float) * hits.ng).sum(axis=0) > 3e-7)
    free = built.accelerator.unoccluded(hits.near_origin, d, 1e30, STATS)
    return int((~free & fair).sum()), int(fair.sum())


@fewer
@pytest.mark.parametrize("grazing", [False, True], ids=["all over", "grazing"])
@pytest.mark.parametrize("mesh", CONVEX.values(), ids=list(CONVEX))
def test_rays_that_leave_a_surface_do_not_meet_it_again(mesh: Mesh, grazing: bool) -> None:
    again, rays = self_hits(mesh, grazing)
    assert rays > 30000
    assert again == 0


@pytest.mark.parametrize("name", ["sphere", "fine sphere", "box", "small sphere off centre"])
def test_with_a_64th_of_the_offset_rays_would_meet_it_again(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ray_offset, "OFFSET", ray_offset.OFFSET / 64)
    again, rays = self_hits(CONVEX[name], False)
    assert again > 0.2 * rays


def test_with_a_constant_offset_long_thin_triangles_would_be_met_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(ray_offset, "SLIVER", 1e9)
    again, _ = self_hits(CONVEX["cylinder"], True)
    assert again > 10


def test_rays_leave_a_slender_box_from_close_by() -> None:
    # A line on the floor of a scene 200 across, 60 long, 0.16 wide and 0.01 high.
    built = build_surface([FullPart(shapes.box((0.6, 1e-4, 1.6e-3)), 0)])
    assert len(built.triangles.material) == 4 * 2 * 24 + 4
    assert built.triangles.planes[:, 6].max() < 0.1 * 1e-4


def test_triangles_without_area_are_left_out_and_the_others_keep_their_materials() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0, 0], [1, 1e-60, 0]], float)
    none = [[0, 0, 0], [0, 1, 1], [0, 3, 1], [0, 1, 4]]
    mesh = Mesh(vertices, np.array([none[0], [0, 1, 2], *none[1:]]))
    built = build_surface(
        [FullPart(mesh, 2), FullPart(Mesh(vertices, np.array(none)), 3), FullPart(mesh, 4)]
    )
    assert len(built.triangles.material) == 2
    assert built.triangles.material.tolist() == [2, 4]
    assert np.isfinite(built.triangles.planes).all()
    assert np.isfinite(built.triangles.edges).all()
    assert np.isfinite(built.triangles.inset).all()


def test_nothing_at_all_is_missed_by_every_ray() -> None:
    built = build_surface([])
    direction = np.array([[0.0], [0.0], [1.0]], np.float32)
    assert len(built.triangles.material) == 0
    assert built.accelerator.intersect(direction, direction, STATS).triangle.tolist() == [-1]
    assert built.accelerator.unoccluded(direction, direction, 1e30, STATS).all()


# Closed meshes, and a point inside each.
CLOSED = {
    "sphere": (shapes.sphere(1, 64), (0.1, 0.2, 0.3)),
    "coarse sphere": (shapes.sphere(1, 12), (0.1, 0.2, 0.3)),
    "box": (shapes.box((2, 1.4, 0.8)), (0.1, 0.2, 0.1)),
    "tetrahedron": (tetrahedron(), (0.0, 0.05, 0.02)),
    "cone": (shapes.cone(0.5, 1, 48), (0.0, -0.1, 0.05)),
    "cylinder": (shapes.cylinder(0.5, 1, 48), (0.1, 0.1, 0.1)),
    "displaced sphere": (shapes.displaced_sphere(1, 0.1, 6, 64, 0), (0.05, 0.1, 0)),
    "torus knot": (shapes.torus_knot(2, 3, 0.8, 0.2, 200, 16), None),
}


def closed(name: str, rotate: bool) -> tuple[Mesh, Array]:
    mesh, inside = CLOSED[name]
    # The middle of the knot's first ring lies inside its tube.
    point = mesh.vertices[:16].mean(axis=0) if inside is None else np.array(inside)
    return (turned(mesh), TURN[:3, :3] @ point) if rotate else (mesh, point)


def edge_points(mesh: Mesh, rng: np.random.Generator, n: int, vertices: bool) -> Array:
    """Points on random edges, or at their ends, as float32 knows them."""
    corners = mesh.vertices.astype(np.float32).astype(np.float64)
    triangle, k = mesh.triangles[rng.integers(len(mesh.triangles), size=n)], rng.integers(3, size=n)
    a, b = corners[triangle[np.arange(n), k]], corners[triangle[np.arange(n), (k + 1) % 3]]
    w = np.zeros((n, 1)) if vertices else rng.random((n, 1))
    return (a * (1 - w) + b * w).T


@pytest.mark.parametrize("rotate", [False, True], ids=["straight", "turned"])
@pytest.mark.parametrize("name", CLOSED)
def test_no_ray_from_inside_gets_out_along_an_edge(name: str, rotate: bool) -> None:
    mesh, inside = closed(name, rotate)
    built, rng, n = build_surface([FullPart(mesh, 0)]), np.random.default_rng(8), 40000
    hits = cast(built, np.repeat(inside[:, None], n, axis=1), edge_points(mesh, rng, n, False))
    assert hits.size == n
    # The first thing met from inside is the inside. Where the tube of a knot bends away, its front begins at the very
    # edge that the ray is aimed at, at the same distance to the last bit.
    assert hits.entering.mean() < (1e-3 if name == "torus knot" else 1e-9)
    # From there, light from outside is out of sight in whichever direction.
    free = built.accelerator.unoccluded(hits.near_origin, hemisphere(hits, rng, False), 1e30, STATS)
    assert not (free & ~hits.entering).any()


@pytest.mark.parametrize("rotate", [False, True], ids=["straight", "turned"])
@pytest.mark.parametrize("name", CLOSED)
def test_hardly_a_ray_from_inside_gets_out_through_a_vertex(name: str, rotate: bool) -> None:
    mesh, inside = closed(name, rotate)
    built, rng, n = build_surface([FullPart(mesh, 0)]), np.random.default_rng(8), 40000
    hits = cast(built, np.repeat(inside[:, None], n, axis=1), edge_points(mesh, rng, n, True))
    assert n - hits.size + hits.entering.sum() <= 0.005 * n


def write_obj(path: Path, mesh: Mesh) -> None:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.vertices.tolist()]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in mesh.triangles.tolist()]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture
def obj(tmp_path: Path) -> Callable[[Mesh], dict[str, Any]]:
    """An object that shows a mesh, flat."""

    def make(mesh: Mesh) -> dict[str, Any]:
        write_obj(tmp_path / "mesh.obj", mesh)
        return {"shape": "mesh", "file": "mesh.obj", "material": "white", "shading": "flat"}

    return make


WHITE = {"white": {"color": 1}}
AROUND = [[3, 4, 5], [-3, -4, -5], [-3, 4, -5], [3, -4, 5]]


def points(*positions: Any) -> list[dict[str, Any]]:
    return [{"type": "point", "position": list(p), "intensity": 30} for p in positions]


SOLIDS: list[dict[str, Any]] = [
    {"shape": "box"},
    {"shape": "box", "transform": [{"rotate": {"axis": [1, 2, 3], "degrees": 33}}]},
    {"shape": "sphere", "radius": 0.5},
    {"shape": "sphere", "radius": 0.5, "segments": 8, "shading": "flat"},
    {"shape": "cone"},
    {"shape": "cylinder"},
    {"shape": "displaced_sphere", "radius": 0.5, "amplitude": 0.05, "segments": 64},
]


def seen_within(
    make_scene: MakeScene, thing: dict[str, Any], look_at: list[float], samples: int
) -> NDArray[np.float32]:
    scene = make_scene(
        camera={"eye": [0, 0.05, 0.02], "look_at": look_at, "vertical_fov": 140},
        film={"width": 64, "height": 64},
        sampler={"type": "random", "samples": samples},
        materials=WHITE,
        objects=[thing],
        lights=points(*AROUND),
    )
    return render(scene).linear


@fewer
@pytest.mark.parametrize("solid", SOLIDS)
@pytest.mark.parametrize("look_at", [[1, 0.3, 0.2], [0.2, -1, 0.3]])
def test_inside_a_closed_mesh_no_light_from_outside_is_seen(
    make_scene: MakeScene, solid: dict[str, Any], look_at: list[float]
) -> None:
    assert not seen_within(make_scene, solid | {"material": "white"}, look_at, 64).any()


@pytest.mark.parametrize("look_at", [[-1, -0.4, 0.3], [0.2, -1, 0.3]])
def test_inside_a_tetrahedron_no_light_from_outside_is_seen(
    make_scene: MakeScene, obj: Callable[[Mesh], dict[str, Any]], look_at: list[float]
) -> None:
    # 2 million samples; without pulling points off the edges one or two of them leak.
    assert not seen_within(make_scene, obj(tetrahedron()), look_at, 512).any()


@pytest.mark.parametrize("solid", SOLIDS)
def test_a_light_inside_a_closed_mesh_is_not_seen_from_outside(
    make_scene: MakeScene, solid: dict[str, Any]
) -> None:
    floor = {"shape": "quad", "width": 6, "depth": 6, "transform": [{"translate": [0, -0.7, 0]}]}
    scene = make_scene(
        camera={"eye": [0.5, 1.5, 2.5], "look_at": [0, -0.2, 0]},
        film={"width": 64, "height": 64},
        sampler={"type": "random", "samples": 64},
        materials=WHITE,
        objects=[thing | {"material": "white"} for thing in (solid, floor)],
        lights=[
            *points([0, 0, 0], [0.05, -0.1, 0.1]),
            {"type": "sphere", "center": [0, -0.1, 0], "radius": 0.15, "radiance": 50},
        ],
    )
    assert not render(scene).linear.any()


@pytest.mark.parametrize("distance", [1e-5, 1e-4, 1e-3, 0.1])
@pytest.mark.parametrize("kind", ["point", "rectangle"])
def test_a_light_close_behind_a_wall_does_not_shine_through(
    make_scene: MakeScene, distance: float, kind: str
) -> None:
    z = 0.5 + distance
    light: dict[str, Any] = {"type": "point", "position": [0.1, 0.2, z], "intensity": 1}
    if kind == "rectangle":
        light = {"type": "rectangle", "corner": [0, 0, z], "edge_u": [0.1, 0, 0]}
        light |= {"edge_v": [0, 0.1, 0], "intensity": 1}
    scene = make_scene(
        camera={"eye": [0, 0, -0.4], "look_at": [0, 0.1, 0], "vertical_fov": 90},
        materials=WHITE,
        objects=[{"shape": "box", "material": "white"}],
        lights=[light],
    )
    assert not render(scene).linear.any()


SUN = {"type": "directional", "direction": [0.3, -1, -0.2], "irradiance": 2}
TILT = {"rotate": {"axis": [1, 2, 3], "degrees": 33}}


def sheets(make_scene: MakeScene, distances: list[float], tilt: bool, sun: Any = SUN) -> Any:
    """A picture, from above, of square sheets one above the other."""
    turn = [TILT] if tilt else []
    quad = {"shape": "quad", "material": "white", "width": 2, "depth": 2}
    objects = [quad | {"transform": [{"translate": [0, y, 0]}, *turn]} for y in distances]
    up = TURN[:3, 1] if tilt else np.array([0.0, 1.0, 0.0])
    scene = make_scene(
        camera={"eye": (2 * up + [0.01, 0.02, 0.03]).tolist(), "look_at": [0, 0, 0]}
        | {"up": [1, 0, 0], "vertical_fov": 40},
        film={"width": 48, "height": 48},
        sampler={"type": "sobol", "samples": 16},
        materials={"white": {"color": 1, "specular": 0}},
        objects=objects,
        lights=[sun],
    )
    return render(scene).linear


@pytest.mark.filterwarnings("ignore:.*is a gap of:course.base.errors.CourseWarning")
@pytest.mark.parametrize("tilt", [False, True])
@pytest.mark.parametrize("distance", [0.0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3])
def test_coincident_and_nearly_coincident_sheets_show_no_speckle(
    make_scene: MakeScene, distance: float, tilt: bool
) -> None:
    found = sheets(make_scene, [0.0, distance], tilt)
    up = TURN[:3, 1] if tilt else np.array([0.0, 1.0, 0.0])
    towards = -np.array(SUN["direction"]) / np.linalg.norm(SUN["direction"])
    # One number for the whole picture, whichever sheet a ray finds; the normal is rounded to float32.
    assert np.allclose(found, 2 * (towards @ up) / np.pi, rtol=1e-6)


@pytest.mark.parametrize("distance", [1e-5, 1e-3])
def test_a_sheet_shades_the_one_right_below_it(make_scene: MakeScene, distance: float) -> None:
    # Seen from below, sheets lit from above are dark, the lower one's lit side out of sight.
    sun = SUN | {"direction": [-0.3, 1, 0.2]}
    assert not sheets(make_scene, [0.0, distance], False, sun).any()


@pytest.mark.parametrize("ratio", [1e2, 1e3, 1e4, 1e5, 1e6])
@pytest.mark.parametrize("tilt", [False, True])
def test_slivers_look_like_the_square_that_they_fill(
    make_scene: MakeScene, obj: Callable[[Mesh], dict[str, Any]], ratio: float, tilt: bool
) -> None:
    mesh = strips(ratio)
    up = TURN[:3, 1] if tilt else np.array([0.0, 1.0, 0.0])
    thing = obj(turned(mesh) if tilt else mesh)
    # Looks straight at the middle, where the slivers are; they fill from 3% to all of the picture's height.
    scene = make_scene(
        camera={"eye": (2 * up + [0.01, 0.02, 0.03]).tolist(), "look_at": [0, 0, 0]}
        | {"up": [1, 0, 0], "vertical_fov": 2 * 30 / ratio**0.5},
        film={"width": 48, "height": 48},
        sampler={"type": "sobol", "samples": 16},
        materials=WHITE,
        objects=[thing],
        lights=[SUN],
    )
    towards = -np.array(SUN["direction"]) / np.linalg.norm(SUN["direction"])
    # The corners are rounded to float32, which turns a sliver by 2^-24 length / height.
    assert np.allclose(
        render(scene).linear, 2 * (towards @ up) / np.pi, rtol=1e-6 + 2e-7 * ratio * tilt
    )


def test_zero_area_and_duplicate_triangles_change_nothing(
    make_scene: MakeScene, obj: Callable[[Mesh], dict[str, Any]]
) -> None:
    clean = tetrahedron()
    doubled = np.concatenate((clean.triangles, clean.triangles[::-1], [[0, 1, 1], [2, 2, 2]]))

    def shown(mesh: Mesh) -> Any:
        scene = make_scene(
            camera={"eye": [1, 1.5, 3], "look_at": [0, 0, 0]},
            materials=WHITE,
            objects=[obj(mesh)],
            lights=[*points([2, 3, 4]), {"type": "ambient", "radiance": 0.1}],
        )
        return render(scene, spp=16).linear

    expected = shown(clean)
    assert np.allclose(shown(Mesh(clean.vertices, doubled)), expected, rtol=1e-5, atol=1e-7)
    assert expected.max() > 0.2


@pytest.mark.parametrize("elevation", [1e-6, 1e-5, 1e-4, 1e-2])
@pytest.mark.parametrize("tilt", [False, True])
def test_light_that_grazes_a_plane_reaches_all_of_it(
    make_scene: MakeScene, elevation: float, tilt: bool
) -> None:
    rotation = TURN[:3, :3] if tilt else np.eye(3)
    direction = rotation @ [np.cos(elevation), -np.sin(elevation), 0]
    disk = {"shape": "disk", "material": "white", "segments": 200}
    scene = make_scene(
        camera={"eye": (rotation @ [0.1, 2, 0.1]).tolist(), "look_at": [0, 0, 0]}
        | {"vertical_fov": 35},
        film={"width": 48, "height": 48},
        sampler={"type": "sobol", "samples": 16},
        materials=WHITE,
        objects=[disk | {"transform": [TILT] if tilt else []}],
        lights=[
            {"type": "directional", "direction": direction.tolist(), "irradiance": 1 / elevation}
        ],
    )
    found = render(scene).linear
    # The direction and the normal are rounded to float32: 1e-7 of a cosine of 1e-6.
    assert np.allclose(found, 1 / np.pi, rtol=1e-5 + 3e-7 / elevation)


@pytest.mark.parametrize("tilt", [False, True])
def test_a_light_exactly_on_a_surface_is_finite_and_without_speckle(
    make_scene: MakeScene, tilt: bool
) -> None:
    # On the floor, it lights the wall by the inverse square and the floor not at all.
    turn = [TILT] if tilt else []
    rotation = TURN[:3, :3] if tilt else np.eye(3)
    floor = {"shape": "quad", "material": "white", "width": 2, "depth": 2, "transform": turn}
    upright = {"rotate": {"axis": [1, 0, 0], "degrees": 90}}
    wall = floor | {"transform": [upright, {"translate": [0, 0, -0.9]}, *turn]}
    place = np.array([0.1, 0, 0.2])
    scene = make_scene(
        camera={
            "eye": (rotation @ [0.3, 1.5, 3]).tolist(),
            "look_at": (rotation @ [0, 0.3, 0]).tolist(),
        }
        | {"up": rotation[:, 1].tolist(), "vertical_fov": 40},
        film={"width": 64, "height": 64},
        sampler={"type": "regular", "samples": 1},
        materials=WHITE,
        objects=[floor, wall],
        lights=[{"type": "point", "position": (rotation @ place).tolist(), "intensity": 1}],
    )
    found = render(scene).linear[..., 0].astype(float)
    assert np.isfinite(found).all()
    # The wall's most by far is at its foot, 1.1 away.
    most = 1 / (np.pi * 1.1**2)
    assert 0.9 * most < found.max() < most * (1 + 1e-3)
    lit = found > 0.01 * most
    # All lit pixels are one patch: each lies beside another, and no dark one lies among them.
    inner = lit[1:-1, 1:-1]
    around = sum(np.roll(lit, s, a)[1:-1, 1:-1].astype(int) for s in (-1, 1) for a in (0, 1))
    assert not (inner & (around == 0)).any()
    assert not (~inner & (around == 4)).any()
    assert lit.sum() > 300


def test_a_camera_on_a_surface_sees_what_is_on_its_side(make_scene: MakeScene) -> None:
    floor = {"shape": "quad", "material": "white", "width": 2, "depth": 2}
    scene = make_scene(
        camera={"eye": [0.1, 0, 0.2], "look_at": [0.1, 1, -1], "vertical_fov": 30},
        materials=WHITE,
        objects=[floor],
        lights=points([0, 1, 0]),
        environment={"type": "constant", "radiance": 0.5},
    )
    assert np.array_equal(render(scene).linear, np.full((32, 32, 3), np.float32(0.5)))
