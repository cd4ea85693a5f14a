"""Samplers that spread the error: the same numbers in any block, strata of quadrants, and what is left after a blur."""

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.core.samplers import Block, Sampler
from course.engine.functions.effects import Effects
from course.engine.terms.samplers import FUNCTIONS, make_sampler
from tests.conftest import MakeScene
from tests.lengths import fewer

EFFECTS = Effects("solutions")
NAMES = ("blue_noise", "dithered")
WIDE, HIGH = 40, 24


def sampler(name: str, seed: int = 0, size: tuple[int, int] = (WIDE, HIGH)) -> Sampler:
    return make_sampler(name, seed, *(EFFECTS.function(*f) for f in FUNCTIONS[name]), size=size)


def whole(samples: int, pixels: int = WIDE * HIGH) -> Block:
    return Block(np.arange(pixels, dtype=np.uint32), 0, samples, 0)


@fewer
@pytest.mark.parametrize("samples", [1, 3, 16])
@pytest.mark.parametrize("name", NAMES)
def test_a_pixel_has_its_numbers_in_any_block(name: str, samples: int) -> None:
    pixels = WIDE * HIGH
    for dimension, width in ((0, 2), (5, 1), (7, 3)):
        all_ = sampler(name).draw(whole(samples), dimension, width)
        some = np.array([7, 3, 941, 200], np.uint32)
        there = sampler(name).draw(Block(some, 0, samples, 5), dimension, width)
        expected = all_.reshape(width, pixels, samples)[:, some]
        assert np.array_equal(there.reshape(width, 4, samples), expected)


@pytest.mark.parametrize("samples", [1, 4])
def test_quadrants_of_every_size_have_one_point_in_each_cell(samples: int) -> None:
    # Points n to 2n of Sobol's scrambled sequence are a net if n is a power of 2 and divides the first number.
    side = 16
    u = sampler("blue_noise", 3, (side, side)).draw(whole(samples, side * side), 4, 2)
    u = u.reshape(2, side, side, samples)
    for quadrant in (1, 2, 4, 8, 16):
        cells = int(np.sqrt(quadrant**2 * samples))
        parts = u.reshape(2, side // quadrant, quadrant, side // quadrant, quadrant, samples)
        parts = parts.transpose(1, 3, 0, 2, 4, 5).reshape(-1, 2, quadrant**2 * samples)
        x, y = (parts * cells).astype(int).transpose(1, 0, 2)
        assert (np.sort(cells * y + x, axis=1) == np.arange(cells * cells)).all()


def test_pairs_of_dimensions_have_orders_of_their_own() -> None:
    u = sampler("blue_noise").draw(whole(1), 0, 8)
    # Correlations of 960 independent numbers: 0.032 each, and 7 of these once in 4e11 times.
    assert np.abs(np.corrcoef(u) - np.eye(8)).max() < 7 / np.sqrt(WIDE * HIGH)


def penumbra(make_scene: MakeScene) -> Scene:
    """A floor that sees a part of a lamp, a little more from pixel to pixel."""
    return make_scene(
        camera={"eye": [0, 3, 0.01], "look_at": [0, 0, 0], "vertical_fov": 20},
        film={"width": 64, "height": 64},
        materials={"grey": {"color": 0.8}},
        objects=[
            {"shape": "quad", "material": "grey", "width": 40, "depth": 40},
            {"shape": "quad", "material": "grey", "width": 20, "depth": 20}
            | {"transform": [{"translate": [10.05, 4, 0]}]},
        ],
        lights=[{"type": "sphere", "center": [0.1, 7, 0], "radius": 2, "intensity": 30}],
    )


@pytest.fixture(scope="module")
def right() -> list[NDArray[np.float64]]:
    """The brightness of a picture of 1024 samples, when one test has made it."""
    return []


def errors(
    scene: Scene, name: str, samples: int, right: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(seeds, H, W) against the right picture."""
    made = [render(scene, sampler=name, spp=samples, seed=seed) for seed in range(4)]
    return np.array([p.linear.mean(axis=2, dtype=np.float64) - right for p in made])


@pytest.mark.parametrize(
    ("name", "samples"), [("blue_noise", 1), ("blue_noise", 4), ("dithered", 1)]
)
def test_the_error_is_as_large_and_less_of_it_is_seen_from_afar(
    make_scene: MakeScene, right: list[NDArray[np.float64]], name: str, samples: int
) -> None:
    scene = penumbra(make_scene)
    if not right:
        right.append(render(scene, spp=1024, seed=99).linear.mean(axis=2, dtype=np.float64))
    seen = EFFECTS.function("blue_noise", "perceptual_rmse")
    usual, own = (errors(scene, each, samples, right[0]) for each in ("sobol", name))
    # Measured: from 0.35 to 0.6 of Sobol's after the blur, with 4 seeds of 4,096 pixels; seeds differ by some
    # hundredths, so more than 0.8 would be ten of its standard deviations away.
    assert (own**2).mean() < 1.1 * (usual**2).mean()
    left = [np.sqrt(np.mean([seen(e, 1.5) ** 2 for e in each])) for each in (own, usual)]
    assert left[0] < 0.8 * left[1]


@pytest.mark.parametrize("name", NAMES)
def test_tiles_and_threads_change_no_bit_and_numpy_draws_the_same(
    make_scene: MakeScene, name: str
) -> None:
    scene = penumbra(make_scene)
    one = render(scene, sampler=name, spp=4, threads=1, size=(150, 90)).linear
    assert (
        one.tobytes()
        == render(scene, sampler=name, spp=4, threads=3, size=(150, 90)).linear.tobytes()
    )


def test_a_picture_that_is_wider_than_the_sequence_is_long_begins_it_anew() -> None:
    size = (1 << 15, 1 << 15)
    pixels = np.array([0, (1 << 30) - 1], np.uint32)
    u = sampler("blue_noise", 1, size).draw(Block(pixels, 0, 16, 0), 2, 2)
    assert ((u >= 0) & (u < 1)).all()
