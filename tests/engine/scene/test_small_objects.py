"""A small ball on a huge floor looks as closed forms in float64 say, whatever the floor's width."""

import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.base.errors import CourseWarning
from course.engine.core.ray_offset import OFFSET
from course.engine.formats.meshes.transforms import rotate
from course.engine.render.summary import summarize
from tests.conftest import MakeScene, PixelRays
from tests.lengths import fewer

Array = NDArray[np.float64]

WIDTHS = (2e5, 1e7, 2e7, 1e10)
AXIS = (1.0, 2.0, 3.0)
LAMP = np.array([1.5, 4.0, 1.0])
INTENSITY, ALBEDO = 30.0, 0.6
BALL, ACROSS = np.array([0.0, 1.0, 0.0]), 2.0


def turn(degrees: float) -> Array:
    return np.asarray(rotate(AXIS, degrees)[:3, :3])


def on_floor(
    make_scene: MakeScene, width: float, degrees: float = 0.0, away: float = 0.0, **parts: Any
) -> Scene:
    """A floor, and above its middle (or ``away`` of its width from that) a ball, a lamp and a camera."""
    r = turn(degrees)

    def there(*x: float) -> list[float]:
        return [float(v) for v in r @ np.array(x)]

    def placed(*x: float) -> list[dict[str, Any]]:
        steps: list[dict[str, Any]] = [{"translate": list(x)}]
        return [*steps, {"rotate": {"axis": list(AXIS), "degrees": degrees}}]

    ball = {"shape": "sphere", "radius": ACROSS / 2, "segments": 200, "material": "grey"}
    floor = {"shape": "quad", "width": width, "depth": width, "material": "grey"}
    return make_scene(
        **{
            "camera": {
                "eye": there(1, 3, 6),
                "look_at": there(0, 0.6, 0),
                "up": there(0, 1, 0),
                "vertical_fov": 45,
            },
            "film": {"width": 64, "height": 64},
            "sampler": {"type": "regular", "samples": 1},
            "materials": {"grey": {"color": ALBEDO, "diffuse": 1, "specular": 0}},
            "objects": [
                floor | {"transform": placed(away * width, 0.0, -0.7 * away * width)},
                ball | {"name": "marble", "transform": placed(*BALL)},
            ],
            "lights": [{"type": "point", "position": there(*LAMP), "intensity": INTENSITY}],
        }
        | parts
    )


def closed_form(scene: Scene, pixel_rays: PixelRays, degrees: float, ball: bool = True) -> Array:
    """Radiance (H, W) of the floor y = 0 and a true ball on it, both Lambertian, lit by a point."""
    eye, direction = pixel_rays(scene)
    back = turn(degrees).T
    eye, direction = back @ eye, np.einsum("ij,jhw->ihw", back, direction)
    origin = np.broadcast_to(eye[:, None, None], direction.shape)
    # Above the horizon there is nothing.
    t = np.where(direction[1] < 0, -eye[1] / np.minimum(direction[1], -1e-300), np.inf)
    seen = np.isfinite(t)
    normal = np.broadcast_to(np.array([0, 1.0, 0])[:, None, None], direction.shape).copy()
    if ball:
        to_ball = meets_ball(origin, direction)
        nearer = to_ball < t
        t = np.minimum(t, to_ball)
        outwards = (origin + np.where(nearer, t, 0) * direction - BALL[:, None, None]) / (
            ACROSS / 2
        )
        normal = np.where(nearer, outwards, normal)
        seen |= nearer
    p = origin + np.where(seen, t, 0) * direction
    way = LAMP[:, None, None] - p
    far = np.sqrt((way * way).sum(axis=0))
    cosine = np.maximum((way * normal).sum(axis=0) / far, 0)
    free = ~np.isfinite(meets_ball(p + 1e-9 * normal, way / far)) if ball else True
    return np.asarray(seen * free * ALBEDO / np.pi * INTENSITY * cosine / far**2)


def meets_ball(origin: Array, direction: Array) -> Array:
    """Distance to the ball along rays (3, H, W), infinite where they miss it."""
    away = origin - BALL[:, None, None]
    b = (away * direction).sum(axis=0)
    root = b * b - (away * away).sum(axis=0) + (ACROSS / 2) ** 2
    t = -b - np.sqrt(np.maximum(root, 0))
    return np.asarray(np.where((root > 0) & (t > 0), t, np.inf))


def agree(scene: Scene, compiled: bool, expected: Array) -> None:
    shown = render(scene, compiled=compiled).linear[..., 0].astype(np.float64)
    assert shown.mean() == pytest.approx(expected.mean(), rel=1e-3)
    # But for those pixels that an edge or a shadow's passes through the middle of.
    assert (np.abs(shown - expected) < 1e-3 * expected.max()).mean() > 0.995


@fewer
@pytest.mark.parametrize("degrees", [0.0, 33.0])
@pytest.mark.parametrize("width", [1e3, *WIDTHS])
def test_a_ball_of_1_on_a_huge_floor(
    make_scene: MakeScene, pixel_rays: PixelRays, width: float, degrees: float
) -> None:
    scene = on_floor(make_scene, width, degrees)
    expected = closed_form(scene, pixel_rays, degrees)
    for compiled in (False, True):
        agree(scene, compiled, expected)


@pytest.mark.parametrize("width", WIDTHS)
def test_a_ball_far_from_the_middle_of_the_floor(
    make_scene: MakeScene, pixel_rays: PixelRays, width: float
) -> None:
    scene = on_floor(make_scene, width, away=0.31)
    agree(scene, False, closed_form(scene, pixel_rays, 0.0))


@pytest.mark.parametrize("width", [1e3, *WIDTHS])
def test_a_lamp_just_above_a_huge_floor(
    make_scene: MakeScene, pixel_rays: PixelRays, width: float
) -> None:
    floor = {"shape": "quad", "width": width, "depth": width, "material": "grey"}
    scene = on_floor(make_scene, width, objects=[floor])
    agree(scene, False, closed_form(scene, pixel_rays, 0.0, ball=False))


@pytest.mark.parametrize("width", [1e3, *WIDTHS])
def test_a_ball_in_a_huge_room(make_scene: MakeScene, pixel_rays: PixelRays, width: float) -> None:
    ball = {"shape": "sphere", "radius": ACROSS / 2, "segments": 200, "material": "grey"}
    lifted = {"transform": [{"translate": [0, width / 2, 0]}]}
    room = {"shape": "box", "size": [width, width, width], "material": "grey"} | lifted
    scene = on_floor(
        make_scene, 1.0, objects=[room, ball | {"transform": [{"translate": BALL.tolist()}]}]
    )
    agree(scene, False, closed_form(scene, pixel_rays, 0.0))


def test_two_balls_too_far_apart_are_told_by_name_and_size(make_scene: MakeScene) -> None:
    ball = {"shape": "sphere", "radius": 1, "material": "grey"}
    floor = {"shape": "quad", "width": 1e7, "depth": 1e7, "material": "grey", "name": "desert"}
    other = ball | {"transform": [{"translate": [3e6, 1, 0]}], "name": "marble"}
    with pytest.warns(CourseWarning) as told:
        on_floor(make_scene, 1.0, objects=[floor, ball, other])
    (warning,) = told
    message = str(warning.message)
    assert "scene.yaml:1: objects[1] (sphere) of a width of 2 (and 1 more) is too small" in message
    assert 'objects[0] (quad "desert"), 1e+07 across, reaches 5e+06 away from its' in message


@pytest.mark.parametrize(("width", "small"), [(1e12, False), (1e13, True)])
def test_what_is_smaller_than_float32_holds_is_told(
    make_scene: MakeScene, width: float, small: bool
) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        on_floor(make_scene, width)
    assert [w.category for w in told] == [CourseWarning] * small
    assert all('objects[1] (sphere "marble") of a width of 2' in str(w.message) for w in told)


def test_what_is_too_thin_for_its_own_length_is_told(make_scene: MakeScene) -> None:
    thin = {"shape": "quad", "width": 1e-15, "depth": 3, "material": "grey"}
    with pytest.warns(CourseWarning, match=r"in which it reaches 1.5 away") as told:
        on_floor(make_scene, 1.0, objects=[thin])
    assert "objects[0] (quad) of a width of 1e-15 is too small" in str(told[0].message)


@pytest.mark.parametrize("width", [1e5, 1e6, 1e9])
@pytest.mark.parametrize("slab", [False, True])
def test_a_gap_that_rays_would_cross_is_told(
    make_scene: MakeScene, width: float, slab: bool
) -> None:
    """The roof's shadow was lost in silence; where it isn't, and where round things nearly touch, nothing is told."""
    quad = {"shape": "quad", "width": width, "depth": width, "material": "grey"}
    box = {"shape": "box", "size": [width, 1, width], "material": "grey", "name": "slab"}
    roof = quad | {"width": width / 2, "name": "roof"}
    roof["transform"] = [{"translate": [width / 4, 1, 0]}]
    parts: dict[str, Any] = {
        "materials": {"grey": {}},
        "objects": [box] if slab else [quad, roof],
        "camera": {"eye": [0, width / 2, width], "look_at": [0, 0, 0]},
    }
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        make_scene(**parts)
    said = [str(each.message) for each in told]
    assert len(said) == (width > 1e5)
    named = r'"slab"\) is 1 thick' if slab else r'\(quad\) and .*"roof"\) is a gap of 1,'
    assert all(re.search(named, each) for each in said)


@pytest.mark.parametrize("width", [1e5, 1e6])
@pytest.mark.parametrize("seams", [False, True])
def test_a_gap_within_a_mesh_file_is_told(
    make_scene: MakeScene, tmp_path: Path, width: float, seams: bool
) -> None:
    """A floor and a roof in one file had been one object, whose middle nobody looked at."""
    corners = [(0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)]
    quads = [(shift, side) for shift, side in ((0, 1), (1, 0.5))]
    lines, faces = [], []
    for height, side in quads:
        for which in [(0, 1, 2), (0, 2, 3)] if seams else [(0, 1, 2, 3)]:
            first = len(lines) + 1
            lines += [
                f"v {corners[k][0] * side * width} {height} {corners[k][2] * side * width}"
                for k in which
            ]
            faces.append("f " + " ".join(str(first + k) for k in range(len(which))))
    (tmp_path / "both.obj").write_text("\n".join(lines + faces) + "\n")
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        make_scene(
            materials={"grey": {}},
            objects=[{"shape": "mesh", "file": "both.obj", "material": "grey"}],
            camera={"eye": [0, width / 2, width], "look_at": [0, 0, 0]},
        )
    said = [str(each.message) for each in told]
    assert len(said) == (width > 1e5)
    assert all("between two parts of objects[0] (mesh) is a gap of 1," in each for each in said)


@pytest.mark.parametrize("offsets", [4, 10, 64])
def test_a_shadow_through_a_gap_is_narrower_by_an_offset(
    make_scene: MakeScene, offsets: int
) -> None:
    """As docs/architecture.md says: shadow rays begin an offset above the floor, so they see less of the gap."""
    gap = offsets * OFFSET
    quad = {"shape": "quad", "width": 2, "depth": 2, "material": "grey"}
    roof = quad | {"width": 1, "transform": [{"translate": [-0.5, gap, 0]}]}
    eye = {"eye": [3 * gap, 0.3, 0], "look_at": [3 * gap, 0, 0], "up": [0, 0, 1]}
    scene = make_scene(
        camera=eye | {"vertical_fov": float(np.degrees(2 * np.arctan(10 * gap / 0.3)))},
        film={"width": 64, "height": 16},
        materials={"grey": {}},
        objects=[quad, roof],
        lights=[{"type": "directional", "direction": [1, -1, 0], "irradiance": 3}],
    )
    light = render(scene, spp=64).linear[:, :, 0].mean(axis=0)
    # At the middle of the picture's height 20 gaps are 16 pixels: a pixel is 1.25 of them.
    shadow = 1.25 * (1 - light / light.max()).sum()
    assert shadow == pytest.approx(1 - 1 / offsets, abs=0.02)


def test_balls_that_nearly_touch_are_no_gap(make_scene: MakeScene) -> None:
    balls = [
        {
            "shape": "sphere",
            "radius": 1,
            "material": "grey",
            "transform": [{"translate": [x, 0, 0]}],
        }
        for x in (-1, 1.00001)
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        make_scene(materials={"grey": {}}, objects=balls)


def test_a_camera_on_a_floor_far_from_what_is_small_sees_what_is_above_it(
    make_scene: MakeScene,
) -> None:
    # Where coordinates are large, rays that stop on the floor itself start again from farther above it.
    floor = {"shape": "quad", "width": 1e7, "depth": 1e7, "material": "grey"}
    ball = {"shape": "sphere", "radius": 1, "material": "grey"}
    scene = on_floor(
        make_scene,
        1.0,
        objects=[floor | {"transform": [{"translate": [0, -1e6, 0]}]}, ball],
        camera={"eye": [7, -1e6, 9], "look_at": [8, 0, 9], "up": [1, 0, 0]},
        environment={"type": "constant", "radiance": 1},
        lights=[],
    )
    assert (render(scene).linear == 1).all()


def test_balls_that_are_apart_by_less_are_both_right(make_scene: MakeScene) -> None:
    # The origin is put between them, up to 750 of their sizes from each.
    ball = {"shape": "sphere", "radius": 1, "segments": 200, "material": "grey"}
    floor = {"shape": "quad", "width": 1e7, "depth": 1e7, "material": "grey"}
    shown = []
    for away in (0.0, 1000.0):
        there = ball | {"transform": [{"translate": [away, 1, 0]}]}
        far = ball | {"transform": [{"translate": [3000.0 - away, 1, 0]}]}
        scene = on_floor(
            make_scene,
            1.0,
            objects=[floor, there, far],
            lights=[{"type": "point", "position": [away, 4, 3], "intensity": 30}],
            camera={"eye": [away, 3, 6], "look_at": [away, 0.6, 0], "vertical_fov": 45},
        )
        shown.append(render(scene).linear)
    assert shown[0].mean() == pytest.approx(shown[1].mean(), rel=2e-3)


def test_the_summary_counts_the_objects_triangles_and_says_how_many_are_cut(
    make_scene: MakeScene,
) -> None:
    scene = on_floor(make_scene, 1e7)
    objects = summarize(scene)["objects"]
    assert objects["triangles"] == sum(scene.compiled.triangles)
    pieces = scene.compiled.pieces
    assert objects["pieces"] == f"{pieces:,} triangles more"
    assert (
        len(scene.compiled.world.surface.triangles.material)
        == sum(scene.compiled.triangles) + pieces
    )
    assert 100 < pieces < 1000
    # The frame's unit is none of the scene's lengths here.
    assert float(str(objects["half extent"])) == pytest.approx(5e6, rel=1e-5)
    assert "pieces" not in summarize(on_floor(make_scene, 1e3))["objects"]
