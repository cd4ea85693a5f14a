"""Environments through the engine: what the camera, mirrors and glass see of them, and how they light a plane.

Most of it is judged under one sky, whose radiance is 1 + x, 1 + y and 1 + z in its three channels (skies.py): it shows
every mistake of orientation, and its light has closed forms.

Means are compared as in tests/estimates.py, about 120 of them.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.core.environment import CubeEnvironment
from tests.conftest import MakeScene, PixelRays
from tests.drawn import numbers_drawn, rows
from tests.engine.terms.environments.skies import (
    KINDS,
    TABLE,
    assert_sees,
    environment,
    face_corners,
    form_factor,
    gradient,
    paint_cube,
    unfolded,
)
from tests.estimates import estimate, fresnel
from tests.lengths import fewer

pytestmark = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]

ONE = {"type": "regular", "samples": 1}
WHITE = {"type": "constant", "radiance": 1}
FLOOR = {"shape": "quad", "material": "m", "width": 4, "depth": 4}
AXES = [np.array(middle, float) for middle, _, _ in TABLE]

kinds = pytest.mark.parametrize("kind", KINDS)


def looks(eye: Any, direction: Any, **parts: Any) -> dict[str, Any]:
    """A camera by its direction of view."""
    eye, direction = np.array(eye, float), np.array(direction, float)
    up = [0, 0, 1] if abs(direction[1]) > 0.9 * np.linalg.norm(direction) else [0, 1, 0]
    return {"eye": eye.tolist(), "look_at": (eye + direction).tolist(), "up": up} | parts


# ---------------------------------------------------------------- what is seen


def test_an_unfolded_cube_has_no_seams_in_it() -> None:
    """So that the crosses below are what a painter would make, whatever this project takes for one."""
    size = 64
    for kind in ("horizontal", "vertical"):
        flat = unfolded(paint_cube(gradient, size), kind)
        paper = (flat != 9).all(axis=2)
        for axis in (0, 1):
            jump = np.abs(np.diff(flat, axis=axis)).max(axis=2)
            both = np.logical_and(
                *(np.roll(paper, -k, axis)[: jump.shape[0], : jump.shape[1]] for k in (0, 1))
            )
            assert jump[both].max() < 2 / size


@fewer
@kinds
@pytest.mark.parametrize("lookup", ["seamless", "clamped"])
def test_the_camera_sees_the_sky_in_every_direction(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path, kind: str, lookup: str
) -> None:
    sky = environment(tmp_path, kind, gradient, lookup=lookup)
    for axis in AXES:
        # Wherever the camera stands, the sky is equally far.
        scene = make_scene(
            camera=looks([30, -20, 7], axis, vertical_fov=91),
            film={"width": 41, "height": 41},
            sampler=ONE,
            environment=sky,
        )
        _, direction = pixel_rays(scene)
        assert_sees(render(scene).linear, direction, gradient, 64, kind)


@fewer
@kinds
@pytest.mark.parametrize("axis", AXES, ids=["+x", "-x", "+y", "-y", "+z", "-z"])
def test_each_main_direction_has_its_own_colour(
    make_scene: MakeScene, tmp_path: Path, kind: str, axis: Array
) -> None:
    scene = make_scene(
        camera=looks([0, 0, 0], axis, vertical_fov=1),
        film={"width": 2, "height": 2},
        environment=environment(tmp_path, kind, gradient),
    )
    # The poles of a picture of all directions are as good as any place, though they lie between its pixels.
    assert np.abs(render(scene).linear - (1 + axis)).max() < 0.01


def stripes(direction: Array) -> Array:
    """A sky that turns about the vertical eight times in a circle, most steeply behind the viewer, at the seam."""
    azimuth = np.arctan2(direction[0], -direction[2])
    return np.stack([1 + 0.5 * np.sin(8 * azimuth + shift) for shift in (0, 2, 4)])


def test_the_picture_of_all_directions_is_closed_at_its_seam(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    size = 128
    sky = environment(tmp_path, "lat_long", stripes, size)
    view = {"film": {"width": 300, "height": 1}, "sampler": ONE, "environment": sky}
    # 6 degrees about +z; a column is 0.7 degrees. Where the seam were open, one column would be shown for another,
    # or the last half columns would be of one colour.
    scene = make_scene(camera=looks([0, 0, 0], [0, 0, 1], vertical_fov=6 / 300), **view)
    row = render(scene).linear[0]
    x = np.tan(np.radians(3)) * (2 * (np.arange(300) + 0.5) / 300 - 1)
    # The camera's right is -x when it looks along +z.
    direction = np.stack((-x, np.zeros(300), np.ones(300)))
    expected = stripes(direction / np.linalg.norm(direction, axis=0)).T
    # The second derivative is 32: over columns of 2 pi / 512 interpolation errs by 32 / 8 of the square, and as much
    # again over the texels of 2 / 128 and in the mean of four samples; the slope 4 times half a column is 0.025.
    assert np.abs(row - expected).max() < 3 * 32 / 8 * (2 / size) ** 2 < 4 * np.pi / 512


@pytest.mark.parametrize("scale", [2.5, [2, 0.5, 0.125]])
def test_scale_is_the_radiance_of_white(make_scene: MakeScene, tmp_path: Path, scale: Any) -> None:
    view = {"camera": looks([0, 0, 0], [1, 0.3, -0.6]), "sampler": ONE}
    plain = render(make_scene(environment=environment(tmp_path, "faces", gradient), **view)).linear
    sky = environment(tmp_path, "faces", gradient, scale=scale)
    assert np.allclose(render(make_scene(environment=sky, **view)).linear, plain * scale, rtol=1e-6)


@kinds
def test_a_mirror_sees_the_sky_in_mirrored_directions(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path, kind: str
) -> None:
    tint = np.array([0.9, 0.5, 0.25])
    # A mirror that leans, and whose every side is seen.
    lean = {"rotate": {"axis": [1, 2, 3], "degrees": 50}}
    normal = rotated([0, 1, 0], [1, 2, 3], 50)
    for side in (1, -1):
        scene = make_scene(
            camera=looks(side * normal + 0.1, -side * normal - 0.2, vertical_fov=60),
            sampler=ONE,
            materials={"m": {"color": 0, "mirror": tint.tolist()}},
            objects=[FLOOR | {"width": 40, "depth": 40, "transform": [lean]}],
            environment=environment(tmp_path, kind, gradient),
        )
        _, d = pixel_rays(scene)
        mirrored = d - 2 * np.tensordot(normal, d, 1) * normal[:, None, None]
        picture = render(scene)
        assert picture.receipt.rays["reflection"] == picture.receipt.rays["camera"]
        assert_sees(picture.linear / tint, mirrored, gradient, 64, kind)


def rotated(vector: Any, axis: Any, degrees: float) -> Array:
    """A vector turned about an axis (Rodrigues 1840)."""
    v, k = np.array(vector, float), np.array(axis, float) / np.linalg.norm(axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.asarray(v * c + np.cross(k, v) * s + k * (k @ v) * (1 - c))


@fewer
@kinds
@pytest.mark.parametrize("above", [True, False])
def test_a_surface_of_glass_sees_the_sky_in_refracted_and_mirrored_directions(
    make_scene: MakeScene, pixel_rays: PixelRays, tmp_path: Path, kind: str, above: bool
) -> None:
    n = 1.5
    side = 1 if above else -1
    eta = 1 / n if above else n
    scene = make_scene(
        camera=looks([0, side, 0], [0.2, -side, 0.5], vertical_fov=80),
        sampler=ONE,
        materials={"m": {"color": 0, "dielectric": {"refraction_index": n}}},
        objects=[FLOOR | {"width": 60, "depth": 60}],
        environment=environment(tmp_path, kind, gradient),
        integrator={"cutoff": 0},
    )
    _, d = pixel_rays(scene)
    # Snell and Fresnel, in the plane y = 0.
    share, cos_t = fresnel(np.abs(d[1]), eta)
    refracted = np.stack((eta * d[0], -side * cos_t, eta * d[2]))
    mirrored = d * np.array([1, -1, 1])[:, None, None]
    if not above:
        assert 0.1 < (share == 1).mean() < 0.9, "some rays are totally reflected, some aren't"
    expected = share * gradient(mirrored) + (1 - share) * gradient(refracted)
    off = np.abs(render(scene).linear - np.moveaxis(expected, 0, -1)).max(axis=2)
    # As in assert_sees, for two looks at the sky of which the shares sum to 1.
    assert off.max() < 2 / 64
    assert np.median(off) < 3 / 64**2


@fewer
@kinds
@pytest.mark.parametrize("degrees", [0, 25])
def test_a_glossy_mirror_sees_the_mean_over_its_lobe(
    make_scene: MakeScene, tmp_path: Path, kind: str, degrees: float
) -> None:
    # About an axis r the density of Phong's lobe, (e + 1) / (2 pi) cos^e, has the mean direction r (e + 1) / (e + 2);
    # below the surface there is less than cos(65 degrees)^200 of it.
    exponent = 200
    scene = point_view(
        make_scene,
        np.array([0, 1, 0]),
        environment(tmp_path, kind, gradient),
        {"color": 0, "mirror": 0.5, "gloss": {"lobe": "phong", "exponent": exponent}},
        degrees,
    )
    mirrored = np.array([-math.sin(math.radians(degrees)), math.cos(math.radians(degrees)), 0])
    mean, tolerance = estimate(scene, 64)
    expected = 0.5 * (1 + mirrored * (exponent + 1) / (exponent + 2))
    assert (np.abs(mean - expected) < tolerance + 3 / 64**2).all()
    assert tolerance.max() < 0.002, "the lobe's width, 0.005 in the mean, shows"


# ---------------------------------------------------------------- how it lights


def point_view(
    make_scene: MakeScene,
    normal: Array,
    sky: dict[str, Any],
    material: dict[str, Any] | None = None,
    degrees: float = 10,
    *objects: dict[str, Any],
) -> Scene:
    """Looks at the origin of a square with that normal, from so many degrees beside it."""
    # From +y to the normal about an axis at right angles to both; any axis where it is -y.
    axis = np.cross([0, 1, 0], normal)
    if np.linalg.norm(axis) < 1e-9:
        axis = np.array([0.0, 0, 1])
    angle = math.degrees(math.acos(np.clip(normal[1], -1, 1)))
    turn = {"rotate": {"axis": axis.tolist(), "degrees": angle}}
    eye = rotated(rotated([0, 1, 0], [0, 0, 1], -degrees), axis, angle) * 0.3
    return make_scene(
        camera=looks(eye, -eye, vertical_fov=1e-3),
        film={"width": 16, "height": 16},
        materials={"m": material or {"color": 1}, "black": {"color": 0}},
        objects=[FLOOR | {"transform": [turn]}, *objects],
        environment=sky,
    )


NORMALS = [*AXES, np.array([0.6, 0, 0.8]), np.array([-2, 1, 2]) / 3, np.array([2, -6, -3]) / 7]


def test_under_a_constant_sky_a_plane_shows_its_reflectance_times_the_radiance(
    make_scene: MakeScene,
) -> None:
    color, radiance = np.array([0.2, 0.5, 0.9]), np.array([3, 2, 0.5])
    sky = {"type": "constant", "radiance": radiance.tolist(), "lights": True}
    for normal in NORMALS:
        material = {"color": color.tolist(), "diffuse": 0.7}
        picture = render(point_view(make_scene, normal, sky, material))
        # Every sample brings the same: nothing is left to chance.
        assert np.allclose(picture.linear, 0.7 * color * radiance, rtol=1e-5)
        assert picture.receipt.rays["shadow"] == 256 * 4, "one for each hit"
        assert picture.receipt.numbers == {"pixel": 2 * 256 * 4, "environment": 2 * 256 * 4}


@pytest.mark.parametrize("sampler", ["sobol", "random", "jittered"])
def test_no_sampler_changes_the_mean(make_scene: MakeScene, tmp_path: Path, sampler: str) -> None:
    sky = environment(tmp_path, "faces", gradient, lights=True)
    scene = point_view(make_scene, NORMALS[7], sky)
    mean, tolerance = estimate(scene, 64, sampler=sampler)
    assert (np.abs(mean - (1 + 2 / 3 * NORMALS[7])) < tolerance + 1e-3).all()


@fewer
@pytest.mark.parametrize(
    ("kind", "normal"),
    [("faces", normal) for normal in NORMALS]
    + [(kind, NORMALS[k]) for kind in KINDS if kind != "faces" for k in (5, 7)],
    ids=str,
)
def test_a_plane_is_lit_by_the_cosine_weighted_mean_of_the_sky(
    make_scene: MakeScene, tmp_path: Path, kind: str, normal: Array
) -> None:
    # The mean direction of a hemisphere with the density cos / pi is 2/3 of its normal.
    sky = environment(tmp_path, kind, gradient, lights=True)
    mean, tolerance = estimate(point_view(make_scene, normal, sky))
    # The sky of 64 texels is off by 3 / 64^2 at most, but for 2 / 64 in 2% of it.
    assert (np.abs(mean - (1 + 2 / 3 * normal)) < tolerance + 1e-3).all()
    assert tolerance.max() < 0.01, "the estimate is worth something"


def test_the_side_that_is_seen_is_lit(make_scene: MakeScene, tmp_path: Path) -> None:
    sky = environment(tmp_path, "faces", gradient, lights=True)
    mean, tolerance = estimate(point_view(make_scene, NORMALS[7], sky, degrees=170))
    assert (np.abs(mean - (1 - 2 / 3 * NORMALS[7])) < tolerance + 1e-3).all()


@fewer
@pytest.mark.parametrize("kind", ["horizontal", "lat_long"])
@pytest.mark.parametrize("degrees", [0, 30, 60, 90, 120, 180])
def test_a_half_bright_sky_lights_by_its_angle_to_the_plane(
    make_scene: MakeScene, tmp_path: Path, kind: str, degrees: float
) -> None:
    # Of a hemisphere that leans by an angle, the cosine-weighted share on the bright side is (1 + cos) / 2.
    bright = np.array([0.0, 0, 1]) if kind == "horizontal" else np.array([1.0, 0, 0])

    def sky(d: Array) -> Array:
        return 3.0 * np.stack([np.tensordot(bright, d, 1) > 0] * 3)

    normal = rotated(bright, [0, 1, 0], degrees)
    scene = point_view(make_scene, normal, environment(tmp_path, kind, sky, lights=True))
    mean, tolerance = estimate(scene)
    exact = 3 * (1 + math.cos(math.radians(degrees))) / 2
    # Between bright and dark lies a ramp of 3 texels at most, the same on both sides: second order in its width.
    assert (np.abs(mean - exact) < tolerance + 3 * (3 / 64) ** 2).all()
    assert tolerance.max() < 0.05


@fewer
@pytest.mark.parametrize("normal", NORMALS, ids=str)
def test_a_sky_of_one_bright_face_lights_by_its_form_factor(
    make_scene: MakeScene, tmp_path: Path, normal: Array
) -> None:
    exact = [form_factor(face_corners(face), normal) for face in range(6)]
    assert sum(exact) == pytest.approx(1)
    if normal[1] == 1:
        # The square above, in closed form (Howell, configuration B-3), and the upper halves of the four around it.
        above = 4 / (math.pi * math.sqrt(2)) * math.atan(1 / math.sqrt(2))
        assert exact == pytest.approx([(1 - above) / 4] * 2 + [above, 0] + [(1 - above) / 4] * 2)
    for face in range(0, 6, 3):
        # Three faces at a time, one a channel; clamped, so that each ends at its edges.
        sizes = [np.arange(3) + face == k for k in range(6)]

        def sky(d: Array, sizes: Any = sizes) -> Array:
            where = np.abs(d).argmax(axis=0)
            number = 2 * where + (np.take_along_axis(d, where[None], 0)[0] < 0)
            return 2 * np.moveaxis(np.array(sizes, float)[number], -1, 0)

        painted = environment(tmp_path, "faces", sky, 2, lights=True, lookup="clamped")
        mean, tolerance = estimate(point_view(make_scene, normal, painted), 256)
        off = np.abs(mean - 2 * np.array(exact[face : face + 3]))
        # Where a face is on the horizon there may be nothing, exactly.
        assert (off <= tolerance + 1e-6).all()
        assert tolerance.max() < 0.02


def test_what_stands_before_the_sky_takes_its_light(make_scene: MakeScene) -> None:
    sky = WHITE | {"lights": True}
    square = {"shape": "quad", "material": "black", "width": 2, "depth": 2}
    for x in (0.0, 0.5, 1.5):
        over = square | {"transform": [{"translate": [x, 1, 0]}]}
        scene = point_view(make_scene, np.array([0, 1, 0]), sky, None, 10, over)
        mean, tolerance = estimate(scene, 256)
        corners = np.array([[x - 1, 1, -1], [x + 1, 1, -1], [x + 1, 1, 1], [x - 1, 1, 1]])
        # Shadow rays leave 2^-19 of the half extent above the floor.
        exact = 1 - form_factor(corners, np.array([0.0, 1, 0]))
        assert (np.abs(mean - exact) < tolerance + 1e-4).all()
        assert tolerance.max() < 0.01


def test_a_mirror_shows_what_the_sky_lights(make_scene: MakeScene) -> None:
    """A bounce later the light is sampled as well: a ceiling, lit from below past the mirror it is seen in."""
    mirror = {"shape": "quad", "material": "mirror", "width": 2, "depth": 2}
    ceiling = {"shape": "quad", "material": "m", "width": 4, "depth": 4}
    scene = make_scene(
        camera={"eye": [0.1, 0.5, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-3},
        film={"width": 16, "height": 16},
        materials={"m": {"color": [0.2, 0.4, 0.8]}, "mirror": {"color": 0, "mirror": 0.5}},
        objects=[mirror, ceiling | {"transform": [{"translate": [0, 1, 0]}]}],
        environment=WHITE | {"lights": True},
    )
    mean, tolerance = estimate(scene, 256)
    seen = np.array([-0.2, 1, 0])
    corners = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]) - seen
    exact = 1 - form_factor(corners, np.array([0.0, -1, 0]))
    assert 0.4 < exact < 0.5
    assert (np.abs(mean - 0.5 * np.array([0.2, 0.4, 0.8]) * exact) < tolerance + 1e-4).all()
    assert tolerance.max() < 0.01


def test_facets_of_a_smooth_ball_take_only_the_light_from_behind_them(
    make_scene: MakeScene,
) -> None:
    """No light leaks through: at an angle a between facet and shading normal (1 + cos a) / 2 of the sky is left."""
    segments = 16
    ball = {"shape": "sphere", "material": "m", "radius": 1, "segments": segments}
    scene = make_scene(
        camera={"eye": [0, 1, 3], "look_at": [0, 0, 0], "vertical_fov": 20},
        materials={"m": {"color": 1}},
        objects=[ball],
        environment=WHITE | {"lights": True},
    )
    shown = render(scene, spp=256).linear
    # A facet spans 2 pi / segments; no shading normal is further from its own than that, and most are much nearer.
    least = (1 + math.cos(2 * math.pi / segments)) / 2
    # Binomial shares of 256 samples, if Sobol points did no better than chance: 7 deviations, in 1024 pixels.
    assert shown.min() > least - 7 * math.sqrt(least * (1 - least) / 256)
    assert shown.max() <= 1 + 1e-6
    assert least < shown.mean() < 1
    flat = make_scene(
        camera={"eye": [0, 1, 3], "look_at": [0, 0, 0], "vertical_fov": 20},
        materials={"m": {"color": 1}},
        objects=[ball | {"shading": "flat"}],
        environment=WHITE | {"lights": True},
    )
    assert np.allclose(render(flat).linear, 1, rtol=1e-5)


# ---------------------------------------------------------------- what it costs


PATHS = 32 * 32 * 4


def wall(make_scene: MakeScene, sky: dict[str, Any], material: dict[str, Any]) -> Scene:
    """The left half of the picture is a wall, the right half sky."""
    upright = {"rotate": {"axis": [1, 0, 0], "degrees": 90}}
    return make_scene(
        materials={"m": material},
        objects=[
            FLOOR | {"width": 40, "depth": 40, "transform": [upright, {"translate": [-20, 0, 0]}]}
        ],
        environment=sky,
    )


@fewer
@pytest.mark.parametrize("kind", ["constant", *KINDS])
def test_an_environment_that_lights_nothing_casts_no_ray(
    make_scene: MakeScene, tmp_path: Path, kind: str
) -> None:
    sky = WHITE if kind == "constant" else environment(tmp_path, kind, gradient)
    for lights in ({}, {"lights": False}):
        picture = render(wall(make_scene, sky | lights, {"color": 1}))
        assert picture.receipt.rays["shadow"] == 0
        assert picture.receipt.numbers == {"pixel": 2 * PATHS}
        assert not picture.linear[:, :16].any()
        assert (picture.linear[:, 16:].max(axis=2) > 0.05).all()
    lit = render(wall(make_scene, sky | {"lights": True}, {"color": 1}))
    assert lit.receipt.rays["shadow"] == PATHS / 2, "the sky itself needs no light"
    assert lit.receipt.numbers == {"pixel": 2 * PATHS, "environment": PATHS}
    assert (lit.linear[:, :16] > 0.05).any()
    # What is seen of the sky is the same to the last bit.
    assert (lit.linear[:, 16:] == picture.linear[:, 16:]).all()


@pytest.mark.parametrize("material", [{"color": 0}, {"diffuse": 0}, {"color": 0, "mirror": 1}])
def test_a_sky_lights_only_what_is_diffuse(make_scene: MakeScene, material: dict[str, Any]) -> None:
    picture = render(wall(make_scene, WHITE | {"lights": True}, material))
    assert picture.receipt.rays["shadow"] == 0
    assert picture.receipt.numbers == {"pixel": 2 * PATHS}


def test_the_sky_has_numbers_of_its_own_at_every_bounce(make_scene: MakeScene) -> None:
    plates = [
        FLOOR | {"width": 40, "depth": 40, "transform": [{"translate": [0, y, 0]}]} for y in (0, 2)
    ]
    scene = make_scene(
        camera={"eye": [0, 0.5, 1], "look_at": [0, 0, 0]},
        film={"width": 8, "height": 8},
        materials={"m": {"mirror": 0.9, "gloss": {"lobe": "plane", "roughness": 0.1}}},
        objects=plates,
        lights=[{"type": "sphere", "center": [0, 1, 0], "radius": 0.1, "intensity": 1}],
        environment=WHITE | {"lights": True},
        integrator={"max_depth": 3, "cutoff": 0},
    )
    found = numbers_drawn(scene)
    # Pixel; at four hits the light and the sky; the gloss of the three that go on.
    assert len(found) == 1 + 4 * 2 + 3
    assert len(rows(found)) == len(set(rows(found))) == 2 * len(found)


def black(d: Array) -> Array:
    return np.zeros_like(d)


@pytest.mark.parametrize(
    ("kind", "options"),
    [
        ("constant", {}),
        *((kind, {}) for kind in KINDS),
        ("faces", {"scale": 0}),
        ("lat_long", {"scale": [0, 0, 0]}),
    ],
)
def test_a_black_environment_costs_nothing(
    make_scene: MakeScene,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    kind: str,
    options: dict[str, Any],
) -> None:
    if kind == "constant":
        sky: dict[str, Any] = {"type": "constant", "radiance": [0, 0, 0]}
    else:
        sky = environment(tmp_path, kind, gradient if options else black, 4, **options)

    def looked_up(*_: object) -> None:
        raise AssertionError("looked up")

    monkeypatch.setattr(CubeEnvironment, "radiance", looked_up)
    material = {"color": 1, "mirror": 0.5}
    scene = wall(make_scene, sky | {"lights": True}, material)
    picture = render(scene)
    assert scene.effects.imported == ("supersampling",)
    assert picture.receipt.effects["called"] == ["supersampling.resolve"]
    assert "cube_map" in picture.receipt.effects["skipped"]
    assert picture.receipt.rays["shadow"] == 0
    assert picture.receipt.numbers == {"pixel": 2 * PATHS}
    assert picture.receipt.effects["skipped"]["environment"] == "it is black"
    assert not picture.linear.any()


def test_a_constant_environment_imports_no_cube_map(make_scene: MakeScene, tmp_path: Path) -> None:
    scene = wall(make_scene, WHITE | {"lights": True}, {"mirror": 0.5})
    receipt = render(scene).receipt
    assert "cube_map" not in scene.effects.imported
    assert "cube_map" in receipt.effects["skipped"]
    for lookup, function in (("seamless", "lookup_seamless"), ("clamped", "lookup")):
        sky = environment(tmp_path, "faces", gradient, 4, lookup=lookup)
        scene = wall(make_scene, sky, {"mirror": 0.5})
        assert f"cube_map.{function}" in render(scene).receipt.effects["called"]
        assert "cube_map" in scene.effects.imported
