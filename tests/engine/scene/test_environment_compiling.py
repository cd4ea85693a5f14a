"""From environment to compiled environment: layouts, and errors that name file, line, key and what was expected."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, load_scene
from course.base.errors import SceneError
from course.engine.core.environment import CubeEnvironment
from course.engine.terms.environments.cube_faces import (
    cube_from_cross,
    cube_from_lat_long,
)
from tests.engine.formats.pictures import picture_files
from tests.engine.terms.environments.skies import (
    by_texel,
    cube_directions,
    gradient,
    paint_lat_long,
)

MakeScene = Callable[..., Scene]
Told = Callable[..., str]

GOOD = np.ones((4, 4, 3), np.float32)


def write(path: Path, picture: NDArray[np.floating]) -> None:
    path.write_bytes(picture_files.exr_rgb(picture))


@pytest.fixture
def told(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> Told:
    """What is said of an environment that can't be: one line, without the file's name, and nothing printed besides."""

    def _told(environment: dict[str, Any]) -> str:
        path = tmp_path / "s.yaml"
        # The environment begins on line 4, one key a line.
        lines = ["camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}", "objects: []", "", "environment:"]
        lines += [f"  {key}: {json.dumps(value)}" for key, value in environment.items()]
        path.write_text("\n".join(lines), encoding="utf-8")
        with pytest.raises(SceneError) as caught:
            load_scene(path)
        assert capfd.readouterr() == ("", "")
        message = str(caught.value)
        assert "\n" not in message
        assert message.startswith(f"{path}:")
        return message.removeprefix(f"{path}:").replace(f"{tmp_path}/", "")

    return _told


def six(**replaced: str) -> list[str]:
    return [replaced.get(f"f{number}", "good.exr") for number in range(6)]


@pytest.mark.parametrize(
    ("kind", "given", "where"),
    [
        ("cube", lambda file: {"cross": file}, "6: environment.cross: "),
        ("lat_long", lambda file: {"image": file}, "6: environment.image: "),
        ("cube", lambda file: {"faces": six(f4=file)}, "6: environment.faces[4]: "),
    ],
)
def test_a_picture_that_cannot_be_read_is_told_by_its_key(
    told: Told, tmp_path: Path, kind: str, given: Callable[[str], dict[str, Any]], where: str
) -> None:
    """What else pictures are refused for, and that nothing is printed, tests of reading them hold."""
    write(tmp_path / "good.exr", GOOD)
    dark = GOOD.copy()
    dark[1, 2, 0] = np.nan
    write(tmp_path / "nothing.exr", dark)
    for file, said in (
        ("none.png", "no such file"),
        (
            "nothing.exr",
            "the pixel in column 2, row 1 is not a number, or less than any: mend it where the picture was made",
        ),
    ):
        assert told({"type": kind} | given(file)) == f"{where}{file}: {said}"


@pytest.mark.parametrize(("height", "width"), [(4, 4), (4, 9), (8, 4), (3, 5), (1, 1)])
def test_a_picture_of_all_directions_is_twice_as_wide_as_high(
    told: Told, tmp_path: Path, height: int, width: int
) -> None:
    write(tmp_path / "a.exr", np.ones((height, width, 3), np.float32))
    assert told({"type": "lat_long", "image": "a.exr"}) == (
        "6: environment.image: a picture of all directions is twice as wide as high, "
        f"not {width} x {height}"
    )


@pytest.mark.parametrize(("height", "width"), [(4, 4), (6, 9), (8, 4), (3, 5), (1, 1), (9, 4)])
def test_a_cross_has_its_proportions(told: Told, tmp_path: Path, height: int, width: int) -> None:
    write(tmp_path / "a.exr", np.ones((height, width, 3), np.float32))
    assert told({"type": "cube", "cross": "a.exr"}) == (
        f"6: environment.cross: a cross has proportions 4:3 or 3:4, not {width} x {height}"
    )


def test_faces_are_squares_of_one_size(told: Told, tmp_path: Path) -> None:
    write(tmp_path / "good.exr", GOOD)
    write(tmp_path / "wide.exr", np.ones((4, 5, 3), np.float32))
    write(tmp_path / "small.exr", np.ones((3, 3, 3), np.float32))
    for number, file, size in ((0, "wide.exr", "5 x 4"), (3, "small.exr", "3 x 3")):
        faces = six(**{f"f{number}": file})
        assert told({"type": "cube", "faces": faces}) == (
            f"6: environment.faces[{number}]: all faces are squares of one size, this is {size}"
        )


def test_exactly_one_of_faces_and_cross_is_given(told: Told, tmp_path: Path) -> None:
    write(tmp_path / "good.exr", GOOD)
    expected = "4: environment: give exactly one of faces and cross"
    assert told({"type": "cube"}) == expected
    assert told({"type": "cube", "faces": six(), "cross": "good.exr"}) == expected


@pytest.mark.parametrize(
    ("white", "scale", "radiance"),
    [(1, 1e21, 1e21), (1e21, 1, 1e21), (1e15, [1, 1, 1e6], 1e21), (1e38, 1e100, 1e138)],
)
def test_light_that_float32_cannot_carry_is_refused(
    told: Told, tmp_path: Path, white: float, scale: Any, radiance: float
) -> None:
    write(tmp_path / "good.exr", GOOD * np.float32(white))
    message = told({"type": "cube", "faces": six(), "scale": scale})
    assert message == f"7: environment.scale: radiance is {radiance:g}: expected less than 1e+20"


def test_a_scale_beyond_float32_is_no_trouble_where_the_radiance_is_none(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    picture = GOOD * np.float32([1e-30, 1e-37, 0])
    write(tmp_path / "good.exr", picture)
    sky = {"type": "cube", "faces": six(), "scale": [1e31, 1e39, 1e100]}
    environment = make_scene(environment=sky).compiled.world.environment
    assert isinstance(environment, CubeEnvironment)
    assert np.allclose(environment.faces, [10, 100, 0], rtol=1e-6, atol=0)


# ---------------------------------------------------------------- layouts


def test_texel_directions_are_opengls() -> None:
    for size in (1, 4):
        d = by_texel(size)
        assert d.shape == (6, size, size, 1, 3)
        unit = d[..., 0, :] / np.linalg.norm(d[..., 0, :], axis=-1, keepdims=True)
        assert np.allclose(np.moveaxis(unit, -1, 0), cube_directions(size), atol=1e-15)
        # Subsamples lie evenly in their texel: their mean is its centre.
        assert np.allclose(by_texel(size, 3).mean(axis=3), d[..., 0, :], atol=1e-15)
        finer = by_texel(2 * size)[..., 0, :]
        first = finer.reshape(6, size, 2, size, 2, 3)[:, 0, :, 0, :].reshape(6, 4, 3)
        assert (by_texel(size, 2)[:, 0, 0] == first).all()


@pytest.mark.parametrize("size", [1, 2, 5])
def test_a_cross_is_cut_where_its_cells_are(size: int) -> None:
    # Every pixel of the picture is another number.
    wide = np.arange(12.0 * size * size * 3, dtype=np.float32).reshape(3 * size, 4 * size, 3)
    faces = cube_from_cross(wide)

    def cell(row: int, column: int, flat: NDArray[np.float32]) -> NDArray[np.float32]:
        return flat[row * size : (row + 1) * size, column * size : (column + 1) * size]

    for face, (row, column) in enumerate([(1, 2), (1, 0), (0, 1), (2, 1), (1, 1), (1, 3)]):
        assert (faces[face] == cell(row, column, wide)).all()
    tall = wide.reshape(4 * size, 3 * size, 3)
    faces = cube_from_cross(tall)
    for face, (row, column) in enumerate([(1, 2), (1, 0), (0, 1), (2, 1), (1, 1)]):
        assert (faces[face] == cell(row, column, tall)).all()
    assert (faces[5] == cell(3, 1, tall)[::-1, ::-1]).all(), "turned by half a circle"


@pytest.mark.parametrize(("height", "size"), [(1, 1), (2, 1), (6, 3), (64, 8), (8, 64)])
def test_all_directions_are_resampled_without_gain_or_loss(height: int, size: int) -> None:
    # A constant picture stays exactly what it is, whatever the sizes; no weight is lost at poles and seam.
    constant = np.broadcast_to(np.float32([0.1, 1e-3, 1e3]), (height, 2 * height, 3))
    assert np.allclose(cube_from_lat_long(constant, size), constant[0, 0], rtol=1e-6, atol=0)
    if min(height, size) >= 6:
        faces = cube_from_lat_long(paint_lat_long(gradient, height), size)
        expected = np.moveaxis(gradient(cube_directions(size)), 0, -1)
        # At most half a pixel off anywhere, with a slope of 1 in both directions.
        assert np.abs(faces - expected).max() < math.pi / height + 1 / size**2


@pytest.mark.parametrize(("height", "given", "size"), [(8, None, 4), (1, None, 1), (8, 13, 13)])
def test_the_size_of_the_faces_is_half_the_height_or_as_given(
    make_scene: MakeScene, tmp_path: Path, height: int, given: int | None, size: int
) -> None:
    write(tmp_path / "a.exr", np.ones((height, 2 * height, 3), np.float32))
    scene = make_scene(environment={"type": "lat_long", "image": "a.exr", "size": given})
    environment = scene.compiled.world.environment
    assert isinstance(environment, CubeEnvironment)
    assert environment.faces.shape == (6, size, size, 3)
    assert environment.faces.dtype == np.float32
    assert environment.faces.flags.c_contiguous


@pytest.mark.parametrize("file", ["a.png", "a.hdr", "a.exr"])
def test_pictures_of_every_format_can_be_faces(
    make_scene: MakeScene, tmp_path: Path, file: str
) -> None:
    """White is `scale` in all of them."""
    content = {
        "a.png": picture_files.png(np.full((8, 8, 3), 255)),
        "a.hdr": picture_files.radiance(np.full((8, 8, 4), (128, 128, 128, 129))),
        "a.exr": picture_files.exr_rgb(np.ones((8, 8, 3), np.float16)),
    }
    # In a folder beside the scene, as its path in the scene file says.
    (tmp_path / "sky").mkdir()
    (tmp_path / "sky" / file).write_bytes(content[file])
    sky = {"type": "cube", "faces": [f"sky/{file}"] * 6, "scale": [1, 2, 3]}
    environment = make_scene(environment=sky).compiled.world.environment
    assert isinstance(environment, CubeEnvironment)
    assert (environment.faces == np.float32([1, 2, 3])).all()


def test_a_sun_of_one_pixel_keeps_its_light_wherever_it_stands() -> None:
    """Its radiance times the pixel's solid angle, against the sum over all texels of theirs."""
    height, size = 64, 32
    edges = np.linspace(-1, 1, size + 1)
    corners = np.arctan2(np.outer(edges, edges), np.sqrt(1 + edges[:, None] ** 2 + edges**2))
    solid_angles = np.diff(np.diff(corners, axis=0), axis=1)
    for row in (1, 2, 5, 20, 31, 60):
        for column in (0, 3, 37, 74, 111):
            image = np.zeros((height, 2 * height, 3), np.float32)
            image[row, column] = 1e6
            low, high = np.cos(np.pi * np.array([row + 1, row]) / height)
            expected = 1e6 * np.pi / height * (high - low)
            found = (cube_from_lat_long(image, size)[..., 1] * solid_angles).sum()
            # The rows next to the poles are rings within a texel or two.
            slack = 0.12 if row <= 2 else 0.05
            assert found == pytest.approx(expected, rel=slack), (row, column)
