"""Photons of the environment against closed forms: their power, where they fly, and what glass does to even light.

A matte patch receives the same radiance from wherever it looks, straight or by clear glass. Sums over 4096 evenly
spread photons are within 2% of their means; see each test for others.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course import render
from tests.conftest import MakeScene
from tests.engine.terms.photons.parts import GLASS, GLOBE, ball, caustics, sent, stage_of

EVEN = {"type": "constant", "radiance": [1, 2, 3], "lights": True}


@pytest.mark.parametrize("sampling", ["automatic", "uniform", "power", "inversion", "alias"])
def test_even_light_sends_pi_times_itself_through_each_part_of_the_ball(
    make_scene: MakeScene, sampling: str
) -> None:
    """4 pi r^2 of a ball's surface take in pi L each."""
    scene = caustics(make_scene, environment=EVEN | {"sampling": sampling}, lights=[])
    origin, way, power = sent(scene, everywhere=False)
    expected = 4 * np.pi * 0.3**2 * np.pi * np.array([1, 2, 3])
    assert power.sum(axis=1) == pytest.approx(expected, rel=0.02)
    # From beyond the scene, towards the ball, and alike from all sides.
    middle = np.array([[0], [0.8], [0]])
    off = np.cross((origin - middle).T, way.T)
    assert (np.linalg.norm(off, axis=1) <= 0.3 * 1.001).all()
    # The corners of the floor are 5.7 away; the disk lies beyond by its radius.
    assert ((origin - middle) * way).sum(axis=0).max() < -6
    mean = (way * power.sum(axis=0)).sum(axis=1) / power.sum()
    assert np.abs(mean).max() < 0.03


def test_photons_of_a_picture_come_from_where_it_is_bright(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    """A square of a face that is 1, seen under a solid angle in closed form; the rest is black."""
    faces = []
    for name in "abcdef":
        pixels = np.zeros((8, 8, 3), np.uint8)
        if name == "c":
            # The face above, its middle: a quarter of each edge to both sides.
            pixels[2:6, 2:6] = 255
        Image.fromarray(pixels).save(tmp_path / f"{name}.png")
        faces.append(f"{name}.png")
    scene = caustics(
        make_scene, environment={"type": "cube", "faces": faces, "lights": True}, lights=[]
    )
    _, way, power = sent(scene, n=20_000, everywhere=False)
    # Interpolation blurs the edges of the square, a texel of 8, to both sides alike in a face's plane.
    angle = 4 * np.arctan(0.25 / np.sqrt(1 + 2 * 0.25))
    assert power.sum(axis=1) == pytest.approx(np.full(3, np.pi * 0.09 * angle), rel=0.05)
    lit = power[0] > 0
    assert lit.mean() > 0.4
    assert (-way[1, lit] > 0.75).all()


PATCH = {"shape": "quad", "material": "white", "width": 0.1, "depth": 0.1}


@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_a_clear_ball_in_even_light_throws_no_shadow(make_scene: MakeScene, kind: str) -> None:
    """The patch is so small that the ball shows little of it to itself: what it sees is the sky, in all directions.

    Light that has been mirrored more than 12 times within the ball is less than 1e-4.
    """
    scene = caustics(
        make_scene,
        camera={"eye": [0, 0.2, 0.001], "look_at": [0, 0, 0], "vertical_fov": 10},
        film={"width": 4, "height": 4},
        materials={"white": {"color": 0.1}, "m": GLASS},
        environment=EVEN,
        lights=[],
        objects=[PATCH, ball(0.3, 0.6, segments=128)],
        photons={"count": 60_000, "radius": 0.03},
        integrator={"type": kind, "max_depth": 14},
    )
    made = render(scene, spp=64)
    found = made.linear.astype(np.float64).mean(axis=(0, 1)) / (0.1 * np.array([1, 2, 3]))
    dark = caustics(
        make_scene,
        camera={"eye": [0, 0.2, 0.001], "look_at": [0, 0, 0], "vertical_fov": 10},
        film={"width": 4, "height": 4},
        materials={"white": {"color": 0.1}, "m": GLASS},
        environment=EVEN,
        lights=[],
        objects=[PATCH, ball(0.3, 0.6, segments=128)],
        photons=None,
        integrator={"max_depth": 14},
    )
    # The ball covers a sixth of what lights the patch: 1 - cos of its edge, weighed by the cosine.
    shadow = render(dark, spp=16).linear.astype(np.float64).mean(axis=(0, 1))
    assert shadow / (0.1 * np.array([1, 2, 3])) == pytest.approx(np.full(3, 1 - 0.25), abs=0.02)
    assert found == pytest.approx(np.ones(3), abs=0.015)


def test_an_environment_that_lights_no_surface_sends_none(make_scene: MakeScene) -> None:
    def lamps(**more: Any) -> list[str]:
        return [
            light.name for light in stage_of(caustics(make_scene, lights=[GLOBE], **more)).lights
        ]

    assert lamps(environment=EVEN) == ["light 0", "the environment"]
    assert lamps(environment=EVEN | {"lights": False}) == ["light 0"]
