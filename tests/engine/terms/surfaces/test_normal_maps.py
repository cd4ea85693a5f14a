"""Normal maps: a constant one is a turned normal, in the frame of u, v and the normal, whatever the shape."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import SceneError
from course.engine.formats.meshes.files import save_ply
from course.engine.formats.pictures.files import save, write_exr
from course.engine.loops import embree_device
from course.engine.scene.building.textures import Painter
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.normal_maps import NormalMap, _turned
from tests.conftest import MakeScene
from tests.engine.formats.pictures.picture_files import png

M = np.array([0.3, -0.2, 0.8]) / np.linalg.norm([0.3, -0.2, 0.8])
"""Along u, along v, along the normal."""

X, Y, Z = np.eye(3)
TURN = {"rotate": {"axis": [0, 0, 1], "degrees": 90}}


def write_map(folder: Path, normal: Any = M, name: str = "map.exr") -> str:
    """A constant map."""
    color = (np.array(normal, float) + 1) / 2
    write_exr(folder / name, np.tile(color[:, None, None], (1, 2, 2)).astype(np.float32))
    return name


def lit(
    make_scene: MakeScene,
    thing: dict[str, Any],
    point: Any,
    away: Any,
    image: str | None = "map.exr",
    **more: Any,
) -> Any:
    """Cosines at a point for light along x, y and z and against them, (6,): the normal, and minus it."""
    found = []
    drawn = {"interpolation": more.pop("interpolation", "bilinear")}
    material = {"color": 1} | ({} if image is None else {"normal_map": {"image": image} | drawn})
    if "bump" in more:
        material["bump"] = more.pop("bump")
    compiled = more.pop("compiled", False)
    for axis in (*np.eye(3), *-np.eye(3)):
        up = [0, 0, -1] if abs(np.array(away, float)[1]) > 0.9 * np.linalg.norm(away) else [0, 1, 0]
        point = np.array(point, float)
        scene = make_scene(
            camera={
                "eye": (point + away).tolist(),
                "look_at": point.tolist(),
                "up": up,
                "vertical_fov": 1e-3,
            },
            film={"width": 1, "height": 1},
            sampler={"type": "regular", "samples": 1},
            materials={"bumpy": material},
            objects=[thing | {"material": "bumpy"}],
            lights=[{"type": "directional", "direction": (-axis).tolist(), "irradiance": np.pi}],
            **more,
        )
        found.append(render(scene, compiled=compiled).linear[0, 0, 0])
    return np.array(found)


QUAD = {"shape": "quad", "width": 2, "depth": 2}


@pytest.mark.parametrize("compiled", [False, True])
def test_a_constant_map_on_a_quad_is_a_turned_normal(
    make_scene: MakeScene, tmp_path: Path, compiled: bool
) -> None:
    """Its u is x, its v is -z. Where light comes from below the surface, that hides it."""
    if compiled and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    write_map(tmp_path)
    found = lit(make_scene, QUAD, (0.1, 0, 0.2), (0.1, 2, 0), compiled=compiled)
    expected = M[0] * X - M[1] * Z + M[2] * Y
    visible = np.array([*np.maximum(expected, 0), *np.maximum(-expected, 0)])
    np.testing.assert_allclose(found[:5], visible[:5], atol=2e-4)


def test_a_nearest_map_has_no_mixtures(make_scene: MakeScene, tmp_path: Path) -> None:
    """Two pixels side by side; at u = 0.45, two fifths of the way between their middles."""
    color = np.stack(((M + 1) / 2, (np.array([0, 0, 1]) + 1) / 2), axis=1)[:, None]
    write_exr(tmp_path / "map.exr", color.astype(np.float32))
    place = (-0.1, 0, 0.2), (0.1, 2, 0)
    found = lit(make_scene, QUAD, *place, interpolation="nearest")
    expected = M[0] * X - M[1] * Z + M[2] * Y
    visible = np.array([*np.maximum(expected, 0), *np.maximum(-expected, 0)])
    np.testing.assert_allclose(found[:5], visible[:5], atol=2e-4)
    mixed = M * 0.6 + np.array([0, 0, 1]) * 0.4
    mixed /= np.linalg.norm(mixed)
    found = lit(make_scene, QUAD, *place)
    np.testing.assert_allclose(found[:3], [mixed[0], mixed[2], -mixed[1]], atol=2e-4)


def test_its_back_has_the_normal_turned_round(make_scene: MakeScene, tmp_path: Path) -> None:
    write_map(tmp_path)
    found = lit(make_scene, QUAD, (0.1, 0, 0.2), (0.1, -2, 0))
    expected = -(M[0] * X - M[1] * Z + M[2] * Y)
    np.testing.assert_allclose(found[[0, 2]], np.maximum(expected, 0)[[0, 2]], atol=3e-4)
    np.testing.assert_allclose(found[3:], np.maximum(-expected, 0), atol=3e-4)


@pytest.mark.parametrize(
    ("steps", "u", "v", "n"),
    [
        ([], X, -Z, Y),
        ([TURN], Y, -Z, -X),
        ([{"scale": [3, 1, 1]}], X, -Z, Y),
        # A mirrored quad has a mirrored picture, and its front is where it was: v is on the other side of u.
        ([{"scale": [-1, 1, 1]}], -X, -Z, Y),
    ],
)
def test_the_frame_goes_with_the_object(
    make_scene: MakeScene, tmp_path: Path, steps: Any, u: Any, v: Any, n: Any
) -> None:
    write_map(tmp_path)
    found = lit(make_scene, QUAD | {"transform": steps}, (0, 0, 0), 2 * n + 0.1 * u + 0.05 * v)
    expected = M[0] * u + M[1] * v + M[2] * n
    for k in range(3):
        if expected[k] > 0 and n[k] >= 0:
            assert found[k] == pytest.approx(expected[k], abs=3e-4)
        if expected[k] < 0 and n[k] <= 0:
            assert found[k + 3] == pytest.approx(-expected[k], abs=3e-4)


@pytest.mark.parametrize("way", [(0, 0, 1), (1, 0, 0), (0.6, 0.5, 0.4), (-0.5, -0.6, 0.4)])
def test_a_ball_has_u_to_the_east_and_v_to_the_north(
    make_scene: MakeScene, tmp_path: Path, way: Any
) -> None:
    """Of 256 segments, whose shading normals are the ball's within 1e-3."""
    write_map(tmp_path)
    n = np.array(way, float) / np.linalg.norm(way)
    east = np.cross(Y, n) / np.linalg.norm(np.cross(Y, n))
    north = np.cross(n, east)
    expected = M[0] * east + M[1] * north + M[2] * n
    ball = {"shape": "sphere", "radius": 1, "segments": 256}
    found = lit(make_scene, ball, n, 2 * n)
    for k in range(3):
        if abs(n[k]) > 0.2 and n[k] * expected[k] > 0:
            assert found[k if n[k] > 0 else k + 3] == pytest.approx(abs(expected[k]), abs=4e-3)


def mesh(folder: Path, uv: Any) -> dict[str, Any]:
    """A square in the plane of x and y that faces +z, with places of its own."""
    vertices = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    save_ply(Mesh(vertices, triangles, None, np.array(uv, float)), folder / "square.ply")
    return {"shape": "mesh", "file": "square.ply"}


@pytest.mark.parametrize(
    ("uv", "u", "v"),
    [
        ([[0, 0], [1, 0], [1, 1], [0, 1]], X, Y),
        ([[1, 0], [0, 0], [0, 1], [1, 1]], -X, Y),
        ([[0, 1], [1, 1], [1, 0], [0, 0]], X, -Y),
        ([[0, 0], [0, 1], [-1, 1], [-1, 0]], -Y, X),
    ],
)
def test_a_mesh_has_the_frame_of_its_places(
    make_scene: MakeScene, tmp_path: Path, uv: Any, u: Any, v: Any
) -> None:
    write_map(tmp_path)
    found = lit(make_scene, mesh(tmp_path, uv), (0.2, 0.1, 0), (0, 0, 3))
    expected = M[0] * u + M[1] * v + M[2] * Z
    np.testing.assert_allclose(found[:3], np.maximum(expected, 0), atol=3e-4)
    np.testing.assert_allclose(found[3:5], np.maximum(-expected[:2], 0), atol=3e-4)


def test_places_that_are_all_one_leave_the_normal_as_it_is(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    write_map(tmp_path)
    found = lit(make_scene, mesh(tmp_path, [[0.5, 0.5]] * 4), (0.2, 0.1, 0), (0, 0, 3))
    np.testing.assert_allclose(found, [0, 0, 1, 0, 0, 0], atol=3e-4)


def test_the_normal_s_own_colour_changes_nothing(make_scene: MakeScene, tmp_path: Path) -> None:
    write_map(tmp_path, (0, 0, 1))
    ball = {"shape": "sphere", "radius": 1, "segments": 64}
    with_map = lit(make_scene, ball, (0, 0, 1), (0.3, 0.2, 2))
    np.testing.assert_allclose(
        with_map, lit(make_scene, ball, (0, 0, 1), (0.3, 0.2, 2), image=None), atol=1e-6
    )


def test_codes_of_a_png_are_taken_as_they_are(make_scene: MakeScene, tmp_path: Path) -> None:
    from PIL import Image

    code = np.array([200, 90, 220], np.uint8)
    Image.fromarray(np.tile(code, (2, 2, 1))).save(tmp_path / "map.png")
    m = 2 * (code / 255) - 1
    m /= np.linalg.norm(m)
    found = lit(make_scene, QUAD, (0.1, 0, 0.2), (0, 2, 0), "map.png")
    np.testing.assert_allclose(found[:3], [m[0], m[2], -m[1]], atol=3e-4)


def test_16_bits_are_16_bits(make_scene: MakeScene, tmp_path: Path) -> None:
    """Along u the normal is 1e-3, a quarter of a code of 8 bits."""
    code = np.round((np.array([1e-3, 0, 1]) + 1) / 2 * 65535).astype(int)
    (tmp_path / "map.png").write_bytes(png(np.tile(code, (2, 2, 1)), 16))
    found = lit(make_scene, QUAD, (0.1, 0, 0.2), (0, 2, 0), "map.png")
    np.testing.assert_allclose(found[[0, 1]], [1e-3, 1], atol=2e-5)


def test_a_mirror_reflects_by_the_turned_normal(make_scene: MakeScene, tmp_path: Path) -> None:
    """A ray from above comes back along 2 (n . y) n - y, into a part of the sky that has its colour."""
    write_map(tmp_path)
    sky = np.zeros((64, 128, 3))
    n = M[0] * X - M[1] * Z + M[2] * Y
    way = 2 * n[1] * n - Y
    column = (0.5 + np.arctan2(way[0], -way[2]) / (2 * np.pi)) * 128
    row = np.arccos(way[1]) / np.pi * 64
    sky[int(row) - 2 : int(row) + 3, int(column) - 2 : int(column) + 3] = 1
    save(tmp_path / "sky.exr", np.moveaxis(sky, -1, 0).astype(np.float32))
    scene = make_scene(
        camera={"eye": [0, 2, 0], "look_at": [0, 0, 0], "up": [0, 0, -1], "vertical_fov": 1e-3},
        film={"width": 1, "height": 1},
        materials={"m": {"color": 0, "mirror": 1, "normal_map": {"image": "map.exr"}}},
        objects=[QUAD | {"material": "m"}],
        environment={"type": "lat_long", "image": "sky.exr"},
    )
    assert render(scene, compiled=False).linear.min() > 0.9


def test_both_engines_agree(make_scene: MakeScene, tmp_path: Path) -> None:
    if not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    write_map(tmp_path)
    scene = make_scene(
        camera={"eye": [0, 1, 4], "look_at": [0, 0, 0]},
        film={"width": 24, "height": 16},
        materials={"m": {"normal_map": {"image": "map.exr"}, "specular": 0.5}},
        objects=[{"shape": "sphere", "material": "m"}, QUAD | {"material": "m"}],
        lights=[{"type": "point", "position": [2, 3, 3], "intensity": 30}],
    )
    pictures = [render(scene, compiled=each).linear for each in (False, True)]
    np.testing.assert_allclose(*pictures, rtol=1e-4, atol=1e-5)


def test_a_picture_and_a_normal_map_share_what_corners_carry(
    make_scene: MakeScene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_map(tmp_path)
    made = []
    once = Painter._own_coordinates

    def counted(*arguments: Any) -> Any:
        made.append(1)
        return once(*arguments)

    monkeypatch.setattr(Painter, "_own_coordinates", counted)
    both = {"normal_map": {"image": "map.exr"}, "texture": {"image": "map.exr"}}
    make_scene(materials={"m": both}, objects=[QUAD | {"material": "m"}])
    assert len(made) == 1


def test_a_mesh_without_places_is_refused(make_scene: MakeScene, tmp_path: Path) -> None:
    write_map(tmp_path)
    plain = mesh(tmp_path, [[0, 0]] * 4)
    square = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), np.array([[0, 1, 2]]))
    save_ply(square, tmp_path / plain["file"])
    with pytest.raises(SceneError, match="has a normal map, but the mesh has no texture coord"):
        make_scene(
            materials={"m": {"normal_map": {"image": "map.exr"}}},
            objects=[plain | {"material": "m"}],
        )
    with pytest.raises(SceneError, match=r"none\.exr"):
        make_scene(
            materials={"m": {"normal_map": {"image": "none.exr"}}},
            objects=[QUAD | {"material": "m"}],
        )


def test_u_goes_on_across_the_line_where_it_begins() -> None:
    """From 0.99 it grows by 0.03 along one edge, an eighth of it at a time."""

    def places(weights: Any, _corners: Any) -> Any:
        return np.stack((np.mod(0.99 + 0.24 * weights[1], 1), weights[2])).astype(np.float32)

    weights, corners = np.array([[1], [0], [0]], np.float32), np.zeros((3, 3, 1), np.float32)
    for wraps, expected in ((True, 0.24), (False, (0.02 - 0.99) * 8)):
        _, along, other = NormalMap(places, places, wraps).changes(weights, corners)
        np.testing.assert_allclose(along[:, 0], [expected, 0], atol=1e-5)
        np.testing.assert_allclose(other[:, 0], [0, 1], atol=1e-5)


@pytest.mark.parametrize(("color", "axis"), [((1, 0.5, 0.5), 0), ((0.5, 1, 0.5), 1)])
def test_the_frame_is_at_right_angles_to_an_interpolated_normal(color: Any, axis: int) -> None:
    """The triangle lies in the plane of x and y, its shading normal is tilted by 30 degrees about y."""
    tilted = np.array([0.5, 0, np.sqrt(0.75)])
    arrays = (color, tilted, X, Y, (1, 0), (0, 1))
    turned = _turned(*(np.array(each, np.float32)[:, None] for each in arrays))[:, 0]
    expected = [np.array([np.sqrt(0.75), 0, -0.5]), Y][axis]
    np.testing.assert_allclose(turned, expected, atol=1e-6)
