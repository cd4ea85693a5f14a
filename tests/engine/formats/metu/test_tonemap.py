"""A camera's Tonemap: the film's tone mapping, in METU's own numbers."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from course import load_scene, render
from course.base.errors import SceneError
from tests.engine.formats.metu.conftest import MATT, Metu, tree

TONEMAP = {"TMO": "Photographic", "TMOOptions": "0.18 0", "Saturation": "1", "Gamma": "2.2"}


def test_a_tonemap_is_that_of_the_film(metu: Metu) -> None:
    tone = metu.load(tree(camera={"Tonemap": TONEMAP})).loaded.description.film.tone
    assert tone is not None
    assert (tone.key, tone.burn, tone.saturation, tone.gamma) == (0.18, 0, 1, 2.2)
    assert metu.warnings == []


def test_the_codes_are_those_of_the_closed_form(metu: Metu, tmp_path: Path) -> None:
    """All pixels are alike: the luminance is white, and each channel its ratio to it by the power 1 / 2.2."""
    matt = MATT | {"AmbientReflectance": "1 1 0.5", "DiffuseReflectance": "0 0 0"}
    camera = {"ImageResolution": "4 4", "Tonemap": TONEMAP}
    metu.load(tree(camera=camera, materials=[matt]))
    render(load_scene(tmp_path / "scene.yaml")).save(tmp_path / "picture.png")
    blue = (0.5 / (0.2126 + 0.7152 + 0.0722 * 0.5)) ** (1 / 2.2)
    codes = np.asarray(Image.open(tmp_path / "picture.png")).reshape(-1, 3)
    assert (codes == (255, 255, int(255 * blue))).all()


@pytest.mark.parametrize("curve", ["sRGB", "srgb"])
def test_a_gamma_may_be_the_curve_of_srgb(metu: Metu, tmp_path: Path, curve: str) -> None:
    """Below 0.0031308 the curve is a line, above it a power of 1 / 2.4."""
    matt = MATT | {"AmbientReflectance": "1 0.5 0.001", "DiffuseReflectance": "0 0 0"}
    camera = {"ImageResolution": "4 4", "Tonemap": TONEMAP | {"Gamma": curve}}
    metu.load(tree(camera=camera, materials=[matt]))
    assert metu.warnings == []
    render(load_scene(tmp_path / "scene.yaml")).save(tmp_path / "picture.png")
    luminance = 0.2126 + 0.7152 * 0.5 + 0.0722 * 0.001
    green, blue = 1.055 * min(1, 0.5 / luminance) ** (1 / 2.4) - 0.055, 12.92 * 0.001 / luminance
    expected = [255, round(255 * green), round(255 * blue)]
    codes = np.asarray(Image.open(tmp_path / "picture.png")).reshape(-1, 3)
    assert (codes == expected).all()


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"TMOOptions": "0.18"}, "2 numbers, such as 0.18 1"),
        ({"TMOOptions": "0 1"}, "a key from 0 to 100"),
        ({"TMOOptions": "0.18 101"}, "a key from 0 to 100"),
        ({"Gamma": "0"}, "a number > 0"),
        ({"Gamma": "Rec709"}, "1 number, such as 1.5"),
        ({"Gamma": "sRGB 2.2"}, "1 number, such as 1.5"),
    ],
)
def test_what_is_out_of_range_is_refused(metu: Metu, changed: dict[str, str], told: str) -> None:
    with pytest.raises(SceneError, match=told):
        metu.load(tree(camera={"Tonemap": TONEMAP | changed}))


def test_what_is_missing_is_told_with_an_example(metu: Metu) -> None:
    tonemap = {key: value for key, value in TONEMAP.items() if key != "Saturation"}
    told = "Tonemap: Saturation is missing: expected an element of that name, such as 1$"
    with pytest.raises(SceneError, match=told):
        metu.load(tree(camera={"Tonemap": tonemap}))


def test_only_the_first_photographic_tonemap_counts(metu: Metu) -> None:
    others = [{"TMO": "ACES", "Gamma": "2.2"}, TONEMAP, TONEMAP | {"Gamma": "1"}]
    tone = metu.load(tree(camera={"Tonemap": others})).loaded.description.film.tone
    assert tone is not None
    assert tone.gamma == 2.2
    assert len([warning for warning in metu.warnings if "has TMO" in warning]) == 2
