"""Bump maps: a picture that rises evenly is a slope, whatever the shape; noise tilts normals by its gradient."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import SceneError
from course.engine.formats.pictures.files import write_exr
from course.engine.loops import embree_device
from course.engine.terms.surfaces.perlin import noise
from tests.conftest import MakeScene
from tests.engine.terms.surfaces.test_normal_maps import QUAD, TURN, X, Y, Z, lit, mesh

A, B, H = 0.6, -0.3, 0.4
"""How grey rises along u and along v, from 0.4 in the lower left corner, and the height of white."""

SLOPE = {"bump": {"image": "ramp.exr", "height": H}, "image": None}


def write_ramp(folder: Path) -> None:
    """Values of 0.4 + A u + B v in the middles of 8 x 4 pixels; the colours differ, their mean is that."""
    u, v = (np.arange(8) + 0.5) / 8, 1 - (np.arange(4)[:, None] + 0.5) / 4
    grey = 0.4 + A * u + B * v
    write_exr(folder / "ramp.exr", np.stack((grey * 0.5, grey, grey * 1.5)).astype(np.float32))


def unit(v: Any) -> Any:
    return np.asarray(v) / np.linalg.norm(v)


def assert_lit(found: Any, expected: Any, front: Any, atol: float = 3e-4) -> None:
    """Cosines (6,) of light along the axes and against them, where it comes from before the surface."""
    for k, (cosine, axis) in enumerate(
        zip([*expected, *-expected], [*np.eye(3), *-np.eye(3)], strict=True)
    ):
        if axis @ front > -1e-6:
            assert found[k] == pytest.approx(max(cosine, 0), abs=atol)


@pytest.mark.parametrize("compiled", [False, True])
def test_an_even_rise_on_a_quad_is_a_slope(
    make_scene: MakeScene, tmp_path: Path, compiled: bool
) -> None:
    """Two units wide and deep: u grows by a half along x, v by a half along -z."""
    if compiled and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    write_ramp(tmp_path)
    found = lit(make_scene, QUAD, (0.1, 0, 0.2), (0.1, 2, 0), compiled=compiled, **SLOPE)
    assert_lit(found, unit(Y - H * (A * X - B * Z) / 2), Y)


@pytest.mark.parametrize(
    ("steps", "u", "v", "n", "slopes"),
    [
        ([TURN], Y, -Z, -X, (1, 1)),
        ([{"scale": 3}], X, -Z, Y, (1, 1)),
        ([{"scale": [8, 1, 1]}], X, -Z, Y, (2 / 8, 2)),
        ([{"scale": [-1, 1, 1]}], -X, -Z, Y, (1, 1)),
    ],
)
def test_heights_grow_with_the_object(
    make_scene: MakeScene, tmp_path: Path, steps: Any, u: Any, v: Any, n: Any, slopes: Any
) -> None:
    """An uneven scaling makes them as much higher as its mean, the cube root of the volume's."""
    write_ramp(tmp_path)
    thing = QUAD | {"transform": steps}
    found = lit(make_scene, thing, 0.1 * u, 2 * n + 0.1 * u + 0.05 * v, **SLOPE)
    rise = H * (A * slopes[0] * u + B * slopes[1] * v) / 2
    assert_lit(found, unit(n - rise), n)


def test_the_back_of_a_hill_is_a_valley(make_scene: MakeScene, tmp_path: Path) -> None:
    write_ramp(tmp_path)
    found = lit(make_scene, QUAD, (0.1, 0, 0.2), (0.1, -2, 0), **SLOPE)
    assert_lit(found, -unit(Y - H * (A * X - B * Z) / 2), -Y)


@pytest.mark.parametrize(
    ("uv", "u", "v"),
    [
        ([[0, 0], [1, 0], [1, 1], [0, 1]], X, Y),
        ([[0.9, 0.1], [0.1, 0.1], [0.1, 0.9], [0.9, 0.9]], -0.8 * X, 0.8 * Y),
        ([[0, 0], [0, 1], [-1, 1], [-1, 0]], -Y, X),
    ],
)
def test_a_mesh_rises_along_its_places(
    make_scene: MakeScene, tmp_path: Path, uv: Any, u: Any, v: Any
) -> None:
    write_ramp(tmp_path)
    found = lit(make_scene, mesh(tmp_path, uv), (0.2, 0.1, 0), (0, 0, 3), **SLOPE)
    assert_lit(found, unit(Z - H * (A * u + B * v) / 2), Z)


@pytest.mark.parametrize("way", [(0.1, 0.2, 1), (-0.6, 0.5, 0.4), (-0.3, -0.4, -0.4)])
def test_a_ball_rises_by_longitude_and_latitude(
    make_scene: MakeScene, tmp_path: Path, way: Any
) -> None:
    """Away from the seam at +x; along the equator u grows by 1 / (4 pi) a unit, along a meridian v by 1 / (2 pi)."""
    write_ramp(tmp_path)
    n = unit(way)
    east = unit(np.cross(Y, n))
    rise = A / (4 * np.pi * np.hypot(n[0], n[2])) * east + B / (2 * np.pi) * np.cross(n, east)
    ball = {"shape": "sphere", "radius": 2, "segments": 256}
    found = lit(
        make_scene, ball, 2 * n, 3 * n, **SLOPE | {"bump": {"image": "ramp.exr", "height": 4}}
    )
    assert_lit(found, unit(n - 4 * rise), n, atol=1e-2)


@pytest.mark.parametrize("conversion", ["linear", "absolute"])
@pytest.mark.parametrize("scale", [1, 2])
def test_noise_tilts_normals_by_its_gradient(
    make_scene: MakeScene, conversion: str, scale: float
) -> None:
    """Its values in a table of double steps: off by less than 1e-3 of slopes that go to 0.6."""
    bump = {"noise": {"scale": 3, "conversion": conversion}, "height": 0.2}
    for x, z in ((0.13, 0.29), (-0.4, 0.37), (0.55, -0.61)):
        step = 1 / 128
        at = 3 * np.array([x, 0, z])[:, None] + step * np.array([X, -X, Z, -Z]).T
        values = noise(at.astype(np.float32)).astype(float)
        values = np.abs(values) if conversion == "absolute" else values / 2
        slope = np.array([values[0] - values[1], 0, values[2] - values[3]]) / (2 * step) * 3
        thing = QUAD | {"transform": [{"scale": scale}]}
        found = lit(
            make_scene, thing, scale * np.array([x, 0, z]), (0, 2, 0), bump=bump, image=None
        )
        assert_lit(found, unit(Y - 0.2 * slope), Y, atol=3e-3)


def test_no_height_changes_nothing(make_scene: MakeScene, tmp_path: Path) -> None:
    write_ramp(tmp_path)
    ball = {"shape": "sphere", "radius": 1, "segments": 64}
    flat = SLOPE | {"bump": {"image": "ramp.exr", "height": 0}}
    with_map = lit(make_scene, ball, (0, 0, 1), (0.3, 0.2, 2), **flat)
    without = lit(make_scene, ball, (0, 0, 1), (0.3, 0.2, 2), image=None)
    np.testing.assert_allclose(with_map, without, atol=1e-6)


def test_both_engines_agree(make_scene: MakeScene) -> None:
    if not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    scene = make_scene(
        camera={"eye": [0, 1, 4], "look_at": [0, 0, 0]},
        film={"width": 24, "height": 16},
        materials={"m": {"bump": {"noise": {"scale": 5}}, "specular": 0.5}},
        objects=[{"shape": "sphere", "material": "m"}, QUAD | {"material": "m"}],
        lights=[{"type": "point", "position": [2, 3, 3], "intensity": 30}],
    )
    pictures = [render(scene, compiled=each).linear for each in (False, True)]
    np.testing.assert_allclose(*pictures, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize(
    ("material", "told"),
    [
        ({"bump": {}}, r"materials\.m\.bump: give exactly one of image and noise"),
        ({"bump": {"image": "a.png", "noise": {}}}, "give exactly one of image and noise"),
        ({"bump": {"noise": {}}, "normal_map": {"image": "a.png"}}, "both normal_map and bump"),
        ({"bump": {"image": "none.exr"}}, r"materials\.m\.bump\.image: .*none\.exr"),
    ],
)
def test_what_is_no_bump_map_is_refused(
    make_scene: MakeScene, material: dict[str, Any], told: str
) -> None:
    with pytest.raises(SceneError, match=told):
        make_scene(materials={"m": material}, objects=[QUAD | {"material": "m"}])


@pytest.mark.parametrize("keys", [{"repeat": [1, 1e-148]}, {"height": 1e6}])
def test_bumps_of_any_size_give_finite_pictures(
    make_scene: MakeScene, tmp_path: Path, keys: dict[str, Any]
) -> None:
    """Enough of a height turns normals along the surface, where light from above doesn't reach."""
    write_ramp(tmp_path)
    bump = {"image": "ramp.exr", "height": H} | keys
    thing = QUAD | {"transform": [{"scale": 1e30}]}
    found = lit(make_scene, thing, (1e29, 0, 2e29), (0, 2e30, 0), bump=bump, image=None)
    slope = keys.get("height", H) * (A * X - (B if "height" in keys else 0) * Z) / 2
    assert_lit(found, unit(Y - slope), Y, atol=1e-3)
