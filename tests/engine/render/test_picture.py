"""Pictures on their way to files and notebooks: shown as the scene's film asks."""

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course import Picture, render
from tests.conftest import MakeScene

WALL = {"shape": "quad", "material": "grey", "width": 100, "depth": 100} | {
    "transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]
}


def half(make_scene: MakeScene, film: dict[str, Any]) -> Picture:
    """A picture of radiance 1/2 all over."""
    return render(
        make_scene(
            film={"width": 8, "height": 8} | film,
            materials={"grey": {"color": 0.5}},
            lights=[{"type": "ambient", "radiance": 1}],
            objects=[WALL],
        )
    )


@pytest.mark.parametrize(
    ("film", "code"),
    [
        # The curve of IEC 61966-2-1: 1.055 x^(1 / 2.4) - 0.055, times 255.
        ({}, 188),
        ({"white": 0.5}, 255),
        ({"white": 2}, 137),
        ({"encoding": "linear"}, 127),
        ({"encoding": "linear", "white": 2}, 63),
        ({"encoding": "linear", "white": 0.25}, 255),
    ],
)
def test_a_png_and_a_notebook_show_what_the_film_asks_for(
    make_scene: MakeScene, tmp_path: Path, film: dict[str, Any], code: int
) -> None:
    picture = half(make_scene, film)
    picture.save(tmp_path / "one.png")
    with Image.open(tmp_path / "one.png") as image:
        assert (np.asarray(image) == code).all()
    with Image.open(io.BytesIO(picture._repr_png_())) as image:
        assert (np.asarray(image) == code).all()


def test_an_exr_holds_the_radiance_whatever_a_png_shows(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    from course.engine.formats.pictures.reading import read_picture

    picture = half(make_scene, {"encoding": "linear", "white": 255})
    picture.save(tmp_path / "one.exr")
    assert (read_picture(tmp_path / "one.exr") == 0.5).all()


def test_a_picture_tells_of_itself_in_one_line(make_scene: MakeScene) -> None:
    told = repr(half(make_scene, {"width": 16}))
    assert re.fullmatch(r"<Picture 16 x 8, \d+ samples a pixel, [\d.]+ s on \d+ threads?>", told)
