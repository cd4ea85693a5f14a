"""Textures of highlights, and surfaces that show a picture whatever the light."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import pixel, render
from course.base.errors import SceneError
from course.engine.formats.pictures.files import write_exr
from course.engine.loops import embree_device
from tests.conftest import MakeScene

COLORS = np.random.default_rng(3).uniform(0.1, 1, (2, 2, 3)).astype(np.float32)
COLOR, SPECULAR = np.array([0.5, 0.3, 0.1]), np.array([0.2, 0.6, 1.5])
KINDS = ["numpy", "compiled"]


@pytest.fixture
def look(make_scene: MakeScene, tmp_path: Path) -> Any:
    """The radiance of a quad in the middle of the pixel in the lower left corner, row 1 and column 0."""
    write_exr(tmp_path / "colors.exr", np.moveaxis(COLORS, -1, 0))

    def _look(material: dict[str, Any], kind: str = "numpy", **parts: Any) -> Any:
        if kind == "compiled" and not embree_device.available():
            pytest.skip("Numba is not installed (pip install .[fast])")
        known: dict[str, Any] = {
            "camera": {"eye": [-0.5, 5, 0.5], "look_at": [-0.5, 0, 0.5], "up": [0, 0, -1]}
            | {"vertical_fov": 1e-3},
            "film": {"width": 1, "height": 1},
            "materials": {"m": material},
            "objects": [{"shape": "quad", "width": 2, "depth": 2, "material": "m"}],
            "lights": [
                {"type": "directional", "direction": [0, -1, 0], "irradiance": math.pi},
                {"type": "ambient", "radiance": 0.25},
            ],
        }
        return render(make_scene(**known | parts), compiled=kind == "compiled").linear[0, 0]

    return _look


SHINY = {"color": COLOR.tolist(), "specular": SPECULAR.tolist(), "exponent": 9}
PICTURE = {"image": "colors.exr"}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("highlight", ["cosine", "phong"])
def test_a_texture_of_the_highlight_multiplies_it_alone(
    look: Any, kind: str, highlight: str
) -> None:
    found = look(SHINY | {"specular_texture": PICTURE, "highlight": highlight}, kind)
    np.testing.assert_allclose(found, 1.25 * COLOR + SPECULAR * COLORS[1, 0], rtol=1e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_both_terms_may_have_textures(look: Any, kind: str) -> None:
    found = look(SHINY | {"specular_texture": PICTURE, "texture": PICTURE}, kind)
    np.testing.assert_allclose(found, (1.25 * COLOR + SPECULAR) * COLORS[1, 0], rtol=1e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_one_of_many_lights_finds_the_texture_of_the_highlight(look: Any, kind: str) -> None:
    light = {"type": "directional", "direction": [0, -1, 0], "irradiance": math.pi / 4}
    choice = {
        "integrator": {"light_sampling": "power"},
        "lights": [light] * 4,
        "sampler": {"samples": 16},
    }
    found = look(SHINY | {"specular_texture": PICTURE}, kind, **choice)
    np.testing.assert_allclose(found, COLOR + SPECULAR * COLORS[1, 0], rtol=1e-4)


@pytest.mark.parametrize("integrator", [{}, {"type": "path", "max_depth": 3}])
@pytest.mark.parametrize("kind", KINDS)
def test_an_unlit_surface_shows_its_picture_whatever_the_light(
    look: Any, kind: str, integrator: dict[str, Any]
) -> None:
    material = {"color": COLOR.tolist(), "unlit": [3, 2, 1], "texture": PICTURE}
    for lights in ([], [{"type": "ambient", "radiance": 4}]):
        found = look(material, kind, integrator=integrator, lights=lights)
        np.testing.assert_allclose(found, COLOR * [3, 2, 1] * COLORS[1, 0], rtol=1e-4)
    plain = look({"color": COLOR.tolist(), "unlit": 2}, kind, integrator=integrator)
    np.testing.assert_allclose(plain, 2 * COLOR, rtol=1e-4)


def test_its_highlight_and_mirror_stay(look: Any) -> None:
    material = SHINY | {"unlit": 2, "mirror": 0.5}
    found = look(material, environment={"type": "constant", "radiance": 3})
    np.testing.assert_allclose(found, 2 * COLOR + SPECULAR + 1.5, rtol=1e-4)


@pytest.mark.parametrize("paths", [False, True])
def test_other_surfaces_mirror_it_and_paths_gather_it(look: Any, paths: bool) -> None:
    """A matt floor 1 below an endless ceiling that shows 2: it gets pi 2 of light, by paths alone."""
    ceiling = {"shape": "quad", "width": 4000, "depth": 4000, "material": "screen"}
    floor = {"shape": "quad", "width": 2, "depth": 2, "material": "m"}
    seen = look(
        {},
        materials={"m": {"color": 0.5, "mirror": 0.25}, "screen": {"color": 1, "unlit": 2}},
        objects=[floor, ceiling | {"transform": [{"translate": [0, 1, 0]}]}],
        camera={"eye": [-0.5, 0.9, 0.5], "look_at": [-0.5, 0, 0.5], "up": [0, 0, -1]}
        | {"vertical_fov": 1e-3},
        integrator={"type": "path", "max_depth": 1} if paths else {},
        sampler={"samples": 64},
        lights=[],
    )
    np.testing.assert_allclose(seen, 0.25 * 2 + (0.5 * 2 if paths else 0), rtol=1e-2)


def test_a_story_says_that_the_surface_glows(make_scene: MakeScene) -> None:
    scene = make_scene(
        materials={"m": {"color": 0.5, "unlit": 2}},
        objects=[{"shape": "sphere", "radius": 9, "material": "m", "name": "screen"}],
        lights=[],
    )
    story = pixel(scene, 1, 1, spp=1)
    assert "screen" in story.reason
    np.testing.assert_allclose(story.color, 1)


@pytest.mark.parametrize(
    ("material", "told"),
    [
        ({"unlit": 1, "dielectric": {"refraction_index": 1.5}}, "expected 0 of a dielectric"),
        ({"unlit": -1}, "unlit"),
        ({"specular": 1, "specular_texture": {"image": "none.exr"}}, r"specular_texture\.image"),
    ],
)
def test_what_can_t_be_painted_is_refused(look: Any, material: dict[str, Any], told: str) -> None:
    with pytest.raises(SceneError, match=told):
        look(material)


def test_a_texture_of_no_highlight_is_never_read(look: Any) -> None:
    look({"specular_texture": {"image": "none.exr"}})
