"""The numbers of one path: every decision has dimensions of its own, and no two of them go together.

Sobol points of one pixel must not only be uncorrelated on average over the pixels (a random sign does that) but
within each pixel: where the lens and a light lie on a diagonal in one pixel and on the other diagonal in the next, no
pixel has the average of both. So the measure is the mean over the pixels of the squared correlation, times n - 1: it
is 1 for independent points, whatever n is. Stratified points spread around that; LOCKED is where a pair that shares
its leading digits begins (at n = 16 two such dimensions have a measure of 9, at n = 64 of 38).

Over P pixels the measure of independent points has a standard deviation of about sqrt(2 / P); with P = 512 and the
bound at 2 that is 16 of them. A measure of a correct shuffle is a mean over pixels of independent permutations, which
no pair takes over 1.6. The false-fail rate of the whole file is below 1e-9.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.core.samplers import Block
from course.engine.functions.effects import Effects
from course.engine.terms.samplers import FUNCTIONS, make_sampler
from tests.conftest import MakeScene
from tests.drawn import numbers_drawn, rows
from tests.lengths import fewer

PIXELS = 512
LOCKED = 2.0


@pytest.fixture
def drawn(make_scene: MakeScene) -> list[tuple[int, int]]:
    """(dimension, width) of everything that the paths of a scene with every effect draw, three bounces deep."""
    ball = {"type": "sphere", "radius": 0.2, "intensity": 1}
    plates = [
        {"shape": "quad", "material": material, "width": 40, "depth": 40}
        | {"transform": [{"translate": [0, y, 0]}]}
        for y, material in ((0, "plane"), (3.5, "ball"))
    ]
    scene = make_scene(
        film={"width": 8, "height": 8},
        sampler={"type": "sobol", "samples": 4},
        camera={"eye": [0, 0.5, 1], "look_at": [0, 0, 0]}
        | {"lens": {"aperture_radius": 0.1, "focus_distance": 1}},
        materials={
            "plane": {"mirror": 0.9, "color": 0.5, "gloss": {"lobe": "plane", "roughness": 0.3}},
            "ball": {"mirror": 0.9, "color": 0.5, "gloss": {"lobe": "ball", "glossiness": 0.3}},
        },
        objects=[plates[0] | {"motion": {"velocity": [1, 0, 0]}}, plates[1]],
        lights=[
            ball | {"center": [-1, 3, 1]},
            ball | {"center": [0, 3, 1], "samples": "ball"},
            ball | {"center": [1, 3, 1], "samples": "facing disk"},
            {"type": "rectangle", "corner": [0, 3, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1]}
            | {"intensity": 1},
        ],
        integrator={"max_depth": 3, "cutoff": 0},
    )
    # Two lobes of one depth may share its numbers: no path meets both at the same depth.
    widest: dict[int, int] = {}
    for dimension, width in numbers_drawn(scene):
        widest[dimension] = max(width, widest.get(dimension, 0))
    return sorted(widest.items())


def test_every_decision_of_a_path_has_dimensions_of_its_own(drawn: list[tuple[int, int]]) -> None:
    assert len(rows(drawn)) == len(set(rows(drawn)))
    # Pixel, lens, time; at each of four hits the four lights, and the gloss of the three that go on.
    assert len(drawn) == 3 + 4 * 4 + 3
    # Floor and ceiling, with lobes of two and three numbers, take turns.
    assert len(rows(drawn)) == 2 + 2 + 1 + 4 * (2 + 3 + 2 + 2) + (2 + 3 + 2)


def measures(
    drawn: list[tuple[int, int]], name: str, samples: int, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """For all pairs of dimensions: the measure of the module's head, and the correlation's mean over the pixels."""
    effects = Effects()
    sampler = make_sampler(
        name, seed, *(effects.function(*each) for each in FUNCTIONS[name]), size=(PIXELS, 1)
    )
    block = Block(np.arange(PIXELS, dtype=np.uint32), 0, samples, 0)
    u = np.concatenate([sampler.draw(block, *numbers) for numbers in drawn]).astype(np.float64)
    z = u.reshape(len(u), PIXELS, samples)
    z -= z.mean(axis=2, keepdims=True)
    z /= np.sqrt((z * z).sum(axis=2, keepdims=True))
    pairs = np.triu_indices(len(z), 1)
    r = np.einsum("apn,bpn->abp", z, z)[pairs]
    return (r * r).mean(axis=1) * (samples - 1), r.mean(axis=1)


@fewer
@pytest.mark.parametrize("samples", [16, 64])
@pytest.mark.parametrize(
    "name", ["sobol", "jittered", "random", "chained", "xorshift", "blue_noise"]
)
def test_no_two_dimensions_of_a_path_go_together_within_a_pixel(
    drawn: list[tuple[int, int]], name: str, samples: int
) -> None:
    measure, _ = measures(drawn, name, samples, seed=3)
    assert measure.max() < LOCKED, f"{(measure >= LOCKED).sum()} of {len(measure)} pairs"


@fewer
@pytest.mark.parametrize("samples", [16, 64])
@pytest.mark.parametrize(
    "name", ["sobol", "jittered", "random", "chained", "xorshift", "blue_noise"]
)
def test_no_two_dimensions_of_a_path_go_together_over_the_picture(
    drawn: list[tuple[int, int]], name: str, samples: int
) -> None:
    # The mean of P independent correlations, each of variance measure / (n - 1); 7 of its standard deviations are
    # 2.6e-12 for each of the 1326 pairs.
    measure, mean = measures(drawn, name, samples, seed=4)
    spread = np.sqrt(np.maximum(measure, 0.2) / (samples - 1) / PIXELS)
    assert (np.abs(mean) < 7 * spread).all()


def test_the_measure_tells_locked_dimensions_from_independent_ones() -> None:
    # Two columns of digits that share their leading four, moved by another word in each pixel: what is to be found.
    rng = np.random.default_rng(5)
    index = np.arange(16)
    shift = rng.integers(0, 16, (2, PIXELS, 1))
    z = ((index ^ shift) + rng.random((2, PIXELS, 16))) / 16
    z -= z.mean(axis=2, keepdims=True)
    z /= np.sqrt((z * z).sum(axis=2, keepdims=True))
    assert 15 * ((z[0] * z[1]).sum(axis=1) ** 2).mean() > 2 * LOCKED
