"""Trilinear textures: the level is that of the pixels that are covered, between two a mixture, from afar the mean."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.engine.formats.pictures.files import write_exr
from course.engine.loops import embree_device
from course.engine.terms.surfaces.pyramids import make_levels
from tests.conftest import MakeScene

COLORS = np.random.default_rng(8).uniform(0.1, 1, (16, 16, 3))
QUAD = {"shape": "quad", "width": 2, "depth": 2}
"""Eight pixels of the picture along a unit."""


def bilinear(picture: Any, u: float, v: float) -> Any:
    """Pixels have their middles at (column + 1/2) / W; v goes up."""
    height, width = picture.shape[:2]
    x, y = u * width - 0.5, (1 - v) * height - 0.5
    p, q = math.floor(x), math.floor(y)
    a, b = x - p, y - q
    upper = picture[q % height, p % width] * (1 - a) + picture[q % height, (p + 1) % width] * a
    q += 1
    lower = picture[q % height, p % width] * (1 - a) + picture[q % height, (p + 1) % width] * a
    return upper * (1 - b) + lower * b


def at_level(picture: Any, level: float, u: float, v: float) -> Any:
    levels = [picture]
    while len(levels[-1]) > 1:
        last = levels[-1]
        levels.append(last.reshape(len(last) // 2, 2, len(last) // 2, 2, 3).mean(axis=(1, 3)))
    k = min(int(level), len(levels) - 1)
    above = levels[min(k + 1, len(levels) - 1)]
    share = level - int(level)
    return bilinear(levels[k], u, v) * (1 - share) + bilinear(above, u, v) * share


@pytest.fixture
def seen(make_scene: MakeScene, tmp_path: Path) -> Any:
    """The middle of a picture of one pixel, whose edge is so long at distance 1."""
    write_exr(tmp_path / "colors.exr", np.moveaxis(COLORS, -1, 0).astype(np.float32))

    def _seen(edge: float, kind: str = "numpy", way: Any = (0, 2, 0), **parts: Any) -> Any:
        if kind == "compiled" and not embree_device.available():
            pytest.skip("Numba is not installed (pip install .[fast])")
        at = np.array(parts.pop("at", (0.13, 0, 0.29)))
        drawn = {"image": "colors.exr", "interpolation": "trilinear"} | parts.pop("drawn", {})
        keys = parts.pop("keys", {"color": 1, "texture": drawn})
        scene = make_scene(
            camera={
                "eye": (at + way).tolist(),
                "look_at": at.tolist(),
                "up": [0, 0, -1] if abs(way[1]) > 1 else [0, 1, 0],
                "vertical_fov": math.degrees(2 * math.atan(edge / 2)),
            },
            film={"width": 1, "height": 1},
            sampler={"type": "regular", "samples": 1},
            materials={"m": keys} | parts.pop("more", {}),
            objects=parts.pop("objects", [QUAD | {"material": "m"}]),
            lights=parts.pop("lights", [{"type": "ambient", "radiance": 1}]),
            **parts,
        )
        return render(scene, compiled=kind == "compiled").linear[0, 0]

    return _seen


U, V = (0.13 + 1) / 2, (1 - 0.29) / 2


@pytest.mark.parametrize(
    ("level", "kind"),
    [*((level, "numpy") for level in (-2, 0, 0.25, 1.5, 2, 3.75, 4, 6)), (1.5, "compiled")],
)
def test_the_level_is_the_logarithm_of_the_pixels_that_are_covered(
    seen: Any, level: float, kind: str
) -> None:
    """Two above the quad: an edge of 2^level / 16 at distance 1 covers 2^level pixels."""
    found = seen(2**level / 16, kind)
    np.testing.assert_allclose(found, at_level(COLORS, max(level, 0), U, V), rtol=1e-3)


@pytest.mark.parametrize("repeat", [(1, 1), (2, 1)])
def test_a_tilted_surface_and_a_picture_that_repeats_are_covered_more(
    seen: Any, repeat: Any
) -> None:
    """The area of what a pixel covers is 1 / cos as large; the repeated picture has more pixels."""
    way = np.array([0, 1.2, 1.6])
    found = seen(1 / 16, way=way, drawn={"repeat": list(repeat)})
    level = math.log2(math.sqrt(repeat[0] / 0.6))
    expected = at_level(COLORS, level, U * repeat[0] % 1, V * repeat[1])
    np.testing.assert_allclose(found, expected, rtol=2e-3)


def test_a_scaled_surface_is_covered_less(seen: Any) -> None:
    wide = QUAD | {"transform": [{"scale": [4, 1, 1]}], "material": "m"}
    found = seen(2**1.5 / 16, at=(4 * 0.13, 0, 0.29), objects=[wide])
    np.testing.assert_allclose(found, at_level(COLORS, 0.5, U, V), rtol=2e-3)


def test_a_ball_is_covered_by_longitude_and_latitude(seen: Any) -> None:
    """Of radius 2, at the equator and -x, where u is a half: 16 pixels are 4 pi long and 2 pi high."""
    ball = {"shape": "sphere", "radius": 2, "segments": 512, "material": "m"}
    pixels = 16 / math.sqrt(8) / math.pi
    found = seen(2**1.5 / pixels, way=(-1, 0, 0), at=(-2, 0, 0), objects=[ball])
    np.testing.assert_allclose(found, at_level(COLORS, 1.5, 0.5, 0.5), rtol=2e-2)


@pytest.mark.parametrize("kind", ["numpy", "compiled"])
def test_a_highlight_s_texture_has_levels_too(seen: Any, kind: str) -> None:
    """Of exponent 0 it is as bright as a matt surface."""
    drawn = {"image": "colors.exr", "interpolation": "trilinear"}
    shiny = {"color": 0, "specular": 1, "specular_texture": drawn, "exponent": 0}
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": math.pi}
    found = seen(2**1.5 / 16, kind, keys=shiny, lights=[sun])
    np.testing.assert_allclose(found, at_level(COLORS, 1.5, U, V), rtol=1e-3)


def test_a_bounced_ray_counts_from_where_it_bounced(seen: Any) -> None:
    """A mirror 3 above the floor, seen from 1 below it: the floor is 3 away."""
    mirror = {"shape": "quad", "material": "mirror", "width": 40, "depth": 40}
    turned = [{"rotate": {"axis": [1, 0, 0], "degrees": 180}}, {"translate": [0, 3, 0]}]
    found = seen(
        2**1.5 / 24,
        way=(0, -2, 0),
        at=(0.13, 3, 0.29),
        objects=[QUAD | {"material": "m"}, mirror | {"transform": turned}],
        more={"mirror": {"color": 0, "mirror": 1}},
    )
    np.testing.assert_allclose(found, at_level(COLORS, 1.5, U, V), rtol=1e-3)


def test_levels_of_any_size_keep_the_mean() -> None:
    for height, width in ((1, 1), (5, 7), (12, 3), (1, 9)):
        picture = np.random.default_rng(1).uniform(0, 1, (height, width, 3)).astype(np.float32)
        levels = make_levels(picture, np.ones(2, np.float32), lambda image, _uv: image[0])
        sizes = [level.image.shape[:2] for level in levels]
        assert sizes[0] == (height, width)
        assert sizes[-1] == (1, 1)
        assert len(levels) == 1 + int(math.log2(max(height, width)))
        for level in levels:
            np.testing.assert_allclose(
                level.image.mean(axis=(0, 1)), picture.mean(axis=(0, 1)), rtol=1e-6
            )
