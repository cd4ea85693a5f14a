"""Things on long thin surfaces look as closed forms in float64 say, whatever the surface's length.

Rays left the two triangles of a plank from as far above as the ball on it is large: its shadow was in pieces.
"""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import render
from course.base.errors import CourseWarning
from course.engine.formats.meshes.transforms import rotate
from tests.conftest import MakeScene, PixelRays
from tests.lengths import fewer

Array = NDArray[np.float64]

RADIUS, WIDTH = 0.05, 0.15
SUN = np.array([0.1, -1.0, 1.0]) / np.sqrt(2.01)
AXIS = (1.0, 2.0, 3.0)
NOTHING, BALL, SHADE, LIT = range(4)


def meets_ball(origin: Array, direction: Array) -> NDArray[np.bool_]:
    """Whether rays (3, H, W) meet the ball that lies on the plank's middle."""
    away = origin - np.array([0, RADIUS, 0])[:, None, None]
    b = (away * direction).sum(axis=0)
    return np.asarray((b < 0) & (b * b > (away * away).sum(axis=0) - RADIUS**2))


def agree(
    make_scene: MakeScene,
    pixel_rays: PixelRays,
    surface: dict[str, Any],
    half: tuple[float, float],
    *,
    degrees: float = 0.0,
    away: tuple[float, float, float] = (0.0, 0.0, 0.0),
    mirror: bool = False,
    look_at: tuple[float, float, float] = (0.0, 0.03, 0.0),
    vertical_fov: float = 20.0,
) -> None:
    """Compare all pixels whose neighbours show the same: nothing, the black ball, its shadow, or the lit plank.

    In a mirror, the lower half of the picture shows what a camera below the floor would see: a glowing ball.

    ``half``: of the plank's extents along x and z
    """
    r, shift = rotate(AXIS, degrees)[:3, :3], np.array(away)

    def there(*x: float) -> list[float]:
        return [float(v) for v in r @ np.array(x) + shift]

    steps = [{"rotate": {"axis": list(AXIS), "degrees": degrees}}, {"translate": list(away)}]
    ball = {"shape": "sphere", "radius": RADIUS, "segments": 200, "material": "ball"}
    up = [float(v) for v in r @ np.array([0, 1.0, 0])]
    scene = make_scene(
        camera={
            "eye": there(0.4, 0.4, 0.6),
            "look_at": there(*look_at),
            "up": up,
            "vertical_fov": vertical_fov,
        },
        film={"width": 120, "height": 90},
        sampler={"type": "regular", "samples": 1},
        materials={
            "plank": {"color": 0, "mirror": 1} if mirror else {"color": 1},
            "ball": {"color": 0, "emission": 1} if mirror else {"color": 0},
        },
        lights=[
            {"type": "directional", "direction": (r @ SUN).tolist(), "irradiance": float(np.pi)}
        ],
        objects=[
            {"material": "plank", "transform": steps} | surface,
            ball | {"transform": [{"translate": [0, RADIUS, 0]}, *steps]},
        ],
    )
    eye, d = pixel_rays(scene)
    eye, d = r.T @ (eye - shift), np.einsum("ij,jhw->ihw", r.T, d)
    start = np.broadcast_to(eye[:, None, None], d.shape)
    p = start - (eye[1] / d[1]) * d
    on = (d[1] < 0) & (np.abs(p[0]) < half[0]) & (np.abs(p[2]) < half[1])
    if mirror:
        shaded = meets_ball(p, d * np.array([1, -1, 1])[:, None, None])
    else:
        shaded = meets_ball(p, np.broadcast_to(-SUN[:, None, None], d.shape))
    what = np.where(meets_ball(start, d), BALL, np.where(on, np.where(shaded, SHADE, LIT), NOTHING))
    values = [0, 1, 1, 0] if mirror else [0, 0, 0, -SUN[1]]
    expected = np.array(values)[what]
    same = np.ones(what.shape, bool)
    for way in ((0, 1), (1, 0), (1, 1), (1, -1)):
        for sign in (1, -1):
            same &= np.roll(what, (sign * way[0], sign * way[1]), (0, 1)) == what
    assert (same & (what == SHADE)).sum() > 100
    assert (same & (what == LIT)).sum() > 100
    for compiled in (False, True):
        shown = render(scene, compiled=compiled).linear[..., 0]
        assert (np.abs(shown - expected) < 1e-3)[same].all()


LENGTHS = (0.15, 1.5, 8.0, 50.0, 100.0, 300.0, 1500.0)
"""From 1 : 1 to 1 : 10,000."""


@fewer
@pytest.mark.parametrize("degrees", [0.0, 33.0])
@pytest.mark.parametrize("length", LENGTHS)
def test_a_balls_shadow_on_a_plank(
    make_scene: MakeScene, pixel_rays: PixelRays, length: float, degrees: float
) -> None:
    plank = {"shape": "quad", "width": WIDTH, "depth": length}
    away = (1e3, -2e3, 500.0) if degrees else (0.0, 0.0, 0.0)
    half = (WIDTH / 2, length / 2)
    agree(make_scene, pixel_rays, plank, half, degrees=degrees, away=away)


def test_the_end_of_a_balls_shadow_on_a_narrow_plank(
    make_scene: MakeScene, pixel_rays: PixelRays
) -> None:
    """The ball is 5 times as wide as the plank, and rays would leave it from 5% of its radius above, a few pixels."""
    plank = {"shape": "quad", "width": 0.02, "depth": 40}
    seen: dict[str, Any] = {"look_at": (0.0, 0.0, 0.12), "vertical_fov": 3.0}
    agree(make_scene, pixel_rays, plank, (0.01, 20), degrees=33.0, **seen)


@pytest.mark.parametrize("length", [2.0, 101.0, 2000.0])
def test_a_balls_image_in_a_long_mirror(
    make_scene: MakeScene, pixel_rays: PixelRays, length: float
) -> None:
    for width, depth in ((2.0, length), (length, 0.4)):
        floor = {"shape": "quad", "width": width, "depth": depth}
        agree(make_scene, pixel_rays, floor, (width / 2, depth / 2), degrees=20.0, mirror=True)


def obj(folder: Path, vertices: Any, faces: Any) -> dict[str, Any]:
    lines = ["v " + " ".join(map(repr, map(float, v))) for v in vertices]
    lines += ["f " + " ".join(str(k + 1) for k in face) for face in faces]
    (folder / "mesh.obj").write_text("\n".join(lines) + "\n")
    return {"shape": "mesh", "file": "mesh.obj", "shading": "flat"}


@pytest.mark.parametrize("length", [50.0, 1500.0])
def test_a_floor_of_caps(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path, length: float
) -> None:
    """Each triangle has its third corner over the middle of its longest edge, which is the floor's."""
    half = length / 2
    ends = [
        (-WIDTH / 2, 0, -half),
        (WIDTH / 2, 0, -half),
        (WIDTH / 2, 0, half),
        (-WIDTH / 2, 0, half),
    ]
    floor = obj(tmp_path, [*ends, (0, 0, 0)], [(4, 1, 0), (4, 2, 1), (4, 3, 2), (4, 0, 3)])
    agree(make_scene, pixel_rays, floor, (WIDTH / 2, half), degrees=33.0)


@pytest.mark.parametrize("length", [50.0, 1500.0])
def test_a_floor_of_needles(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path, length: float
) -> None:
    """A fan: all triangles meet in one corner at the far end, and the ball lies over several of them."""
    x = np.linspace(-WIDTH, WIDTH, 9)
    corners = [(0, 0, -length / 2), *((a, 0, length / 2) for a in x)]
    floor = obj(tmp_path, corners, [(0, k + 1, k + 2) for k in range(8)])
    # In the picture it is as wide as a plank, but for a share of its length.
    agree(make_scene, pixel_rays, floor, (WIDTH / 2, length / 2))


@pytest.mark.parametrize("length", [50.0, 1500.0])
def test_a_plank_that_moves_along_its_length(
    make_scene: MakeScene, pixel_rays: PixelRays, length: float
) -> None:
    plank = {
        "shape": "quad",
        "width": WIDTH,
        "depth": length,
        "motion": {"velocity": [0, 0, 0.5]},
    }
    agree(make_scene, pixel_rays, plank, (WIDTH / 2, length / 2))


def test_a_wall_of_long_tiles_in_a_mesh_with_a_sliver(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path
) -> None:
    """Two rows of planks that share edges with each other, and a sliver of 1 : 10^6 between them."""
    z, x = (-75.0, 0.0, 75.0), (-WIDTH / 2, 0.0, 1e-4, WIDTH / 2)
    corners = [(a, 0, b) for b in z for a in x]
    faces = []
    for row in (0, 4):
        for k in range(row, row + 3):
            faces += [(k, k + 4, k + 5), (k, k + 5, k + 1)]
    wall = obj(tmp_path, corners, faces)
    agree(make_scene, pixel_rays, wall, (WIDTH / 2, 75.0), degrees=33.0)


def told(make_scene: MakeScene, folder: Path, height: float) -> list[str]:
    """What is said of a floor of caps 1 : 1000, and of a roof above it."""
    half, width = 1.0, 2e-3
    ends = [(-half, 0, 0), (half, 0, 0), (half, 0, width), (-half, 0, width), (0, 0, width / 2)]
    faces = [(4, 1, 0), (4, 2, 1), (4, 3, 2), (4, 0, 3)]
    floor = obj(folder, ends, faces)
    roof = {"shape": "quad", "width": 1, "depth": width, "material": "grey"}
    roof["transform"] = [{"translate": [0, height, width / 2]}]
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        make_scene(
            materials={"grey": {}},
            objects=[floor | {"material": "grey"}, roof],
            camera={"eye": [0, 1, 1], "look_at": [0, 0, 0]},
        )
    assert all(one.category is CourseWarning for one in said)
    return [str(one.message) for one in said]


def test_a_gap_that_rays_cross_because_a_floor_is_of_caps_is_told(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    """Rays leave caps of 1 long and 1e-3 high from 2^-25 L^2 / H = 1.2e-4 above, so less where these are cut."""
    assert told(make_scene, tmp_path, 1e-3) == []
    (said,) = told(make_scene, tmp_path, 1e-5)
    assert "is a gap of 1e-05" in said
