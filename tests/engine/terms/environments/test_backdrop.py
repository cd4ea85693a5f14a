"""A picture behind everything: each pixel shows its place of it, whatever the camera, and no other ray sees it."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import SceneError
from course.engine.formats.pictures.files import write_exr
from course.engine.loops import embree_device
from tests.conftest import MakeScene

COLORS = np.random.default_rng(5).uniform(0, 9, (6, 8, 3)).astype(np.float32)
BALL = {"shape": "sphere", "radius": 0.01, "material": "m"}
CAMERA = {"eye": [1, 2, 3], "look_at": [0, 4, 0], "up": [0.1, 1, 0], "vertical_fov": 70}


@pytest.fixture
def picture(make_scene: MakeScene, tmp_path: Path) -> Any:
    """A render of 8 x 6 pixels with the picture behind it."""
    write_exr(tmp_path / "colors.exr", np.moveaxis(COLORS, -1, 0))

    def _picture(kind: str = "numpy", options: Any = None, **parts: Any) -> Any:
        if kind == "compiled" and not embree_device.available():
            pytest.skip("Numba is not installed (pip install .[fast])")
        keys = parts.pop("keys", {"interpolation": "nearest"})
        known: dict[str, Any] = {
            "camera": CAMERA,
            "film": {"width": 8, "height": 6},
            "sampler": {"type": "regular", "samples": 1},
            "materials": {"m": {}},
            "objects": [BALL],
            "environment": {"type": "backdrop", "image": "colors.exr"} | keys,
            "lights": [],
        }
        scene = make_scene(**known | parts)
        return render(scene, compiled=kind == "compiled", **(options or {})).linear

    return _picture


WINDOW = {"left": -0.2, "right": 1.5, "bottom": -0.7, "top": 0.4, "distance": 0.8}


@pytest.mark.parametrize("kind", ["numpy", "compiled"])
@pytest.mark.parametrize(
    "camera",
    [
        {},
        {"handedness": "left"},
        {"image_plane": WINDOW},
        {"lens": {"aperture_radius": 0.1, "focus_distance": 1e9}},
    ],
    ids=str,
)
def test_a_picture_of_its_size_is_seen_pixel_by_pixel(
    picture: Any, kind: str, camera: dict[str, Any]
) -> None:
    camera = CAMERA | camera
    if "image_plane" in camera:
        camera.pop("vertical_fov")
    np.testing.assert_allclose(picture(kind, camera=camera), COLORS, rtol=1e-7)


def test_it_fills_pictures_of_any_size_and_white_has_its_scale(picture: Any) -> None:
    large = picture(
        options={"size": (16, 18)}, keys={"interpolation": "nearest", "scale": [1, 2, 0.5]}
    )
    expected = COLORS.repeat(3, axis=0).repeat(2, axis=1) * [1, 2, 0.5]
    np.testing.assert_allclose(large, expected, rtol=1e-7)


@pytest.mark.parametrize("degrees", [1e-30, 1e-150])
def test_a_view_without_width_sees_something_of_it(picture: Any, degrees: float) -> None:
    seen = picture(camera=CAMERA | {"vertical_fov": degrees})
    assert np.isin(seen, COLORS).all()


def test_between_pixels_are_mixtures_and_nothing_of_the_other_edge(picture: Any) -> None:
    """Twice as wide: places are a quarter of a pixel off the middles."""
    wide = picture(keys={}, options={"size": (16, 6)})
    padded = np.concatenate((COLORS[:, :1], COLORS, COLORS[:, -1:]), axis=1)
    left = 0.75 * COLORS + 0.25 * padded[:, :-2]
    right = 0.75 * COLORS + 0.25 * padded[:, 2:]
    np.testing.assert_allclose(wide[:, 0::2], left, rtol=1e-4)
    np.testing.assert_allclose(wide[:, 1::2], right, rtol=1e-4)


@pytest.mark.parametrize("path", [False, True])
def test_mirrors_and_matt_surfaces_know_nothing_of_it(picture: Any, path: bool) -> None:
    known = {"m": {"mirror": 0.5, "color": 0.5}}
    seen = picture(
        materials=known,
        objects=[{"shape": "sphere", "radius": 50, "material": "m"}],
        camera={"eye": [0, 0, 60], "look_at": [0, 0, 0], "vertical_fov": 130},
        integrator={"type": "path"} if path else {},
    )
    np.testing.assert_array_equal(seen[2:4, 3:5], 0)
    np.testing.assert_allclose(seen[0, 0], COLORS[0, 0], rtol=1e-7)


def test_a_picture_that_is_missing_or_too_bright_is_told(picture: Any) -> None:
    with pytest.raises(SceneError, match=r"environment\.image: .*none\.exr"):
        picture(environment={"type": "backdrop", "image": "none.exr"})
    with pytest.raises(SceneError, match=r"environment\.scale"):
        picture(keys={"scale": 1e30})
