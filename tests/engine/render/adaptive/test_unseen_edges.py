"""Edges near a pixel's border that no sample of it has met: how much is expected of them, and what is reached."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from course import Scene, render
from course.engine.core.types import Floats32
from course.engine.render.adaptive.unseen_edges import unseen_edges

MakeScene = Callable[..., Scene]
HEIGHT, WIDTH = 6, 8
JUMP = 3.0


def columns(values: list[float]) -> Floats32:
    """A grey picture (3, H, W) of even columns."""
    return np.broadcast_to(np.float32(values), (3, HEIGHT, WIDTH)).copy()


STEP = columns([1.0] * 4 + [1.0 + JUMP] * 4)


@pytest.mark.parametrize(("left", "right"), [(8, 8), (4, 16)])
def test_what_is_expected_is_what_even_samples_miss(left: int, right: int) -> None:
    """By 4e5 edges anywhere in two pixels, and jittered samples that meet nothing of them; 5 standard errors.

    One run in 10^5 would fail by chance; the seed is fixed.
    """
    rng = np.random.default_rng(1)
    edges = rng.uniform(-1 / left, 1 / right, 400_000)
    # Of each pixel only the sample nearest to the border can be beyond the edge.
    nearest = np.where(edges < 0, rng.random(len(edges)) / left, rng.random(len(edges)) / right)
    missed = np.abs(edges) < nearest
    samples = np.full((HEIGHT, WIDTH), left, np.int32)
    samples[:, 4:] = right
    pixels, lacking = unseen_edges(STEP, np.zeros((HEIGHT, WIDTH), np.float32), samples)
    assert sorted(set(pixels % WIDTH)) == [3, 4]
    for column, side, n in ((3, edges < 0, left), (4, edges > 0, right)):
        of_each = np.where(side, edges, 0)[missed] ** 2 * JUMP**2
        told = lacking[pixels % WIDTH == column] / n**2
        assert len(told) == HEIGHT
        off = 5 * of_each.std() / math.sqrt(len(of_each))
        assert np.abs(told - of_each.mean()).max() < off


def test_edges_that_are_seen_and_slopes_count_for_nothing() -> None:
    """One of 8 samples beyond an edge makes a variance of its jump's square times 7 / 8^3."""
    samples = np.full((HEIGHT, WIDTH), 8, np.int32)
    variance = np.zeros((HEIGHT, WIDTH), np.float32)
    slope = columns([float(x) for x in range(WIDTH)])
    assert len(unseen_edges(slope, variance, samples)[0]) == 0
    variance[:, 3] = JUMP**2 * 7 / 8**3
    assert len(unseen_edges(STEP, variance, samples)[0]) == 0
    turned = np.swapaxes(np.pad(STEP, ((0, 0), (1, 1), (0, 0)), mode="edge"), 1, 2).copy()
    pixels, _ = unseen_edges(
        turned, np.zeros((WIDTH, WIDTH), np.float32), np.full((WIDTH, WIDTH), 8, np.int32)
    )
    assert sorted(set(pixels // WIDTH)) == [3, 4]


def test_a_row_of_slivers_of_a_lamp_is_not_taken_for_none(make_scene: MakeScene) -> None:
    """A lamp that covers a fiftieth of a row of pixels, by areas; eight samples mostly meet nothing of it.

    Of 40 other triples of seeds the worst reached 0.69 of what is asked for; without what edges hide, ten triples
    reached 1.2 to 1.8 times as much.
    """
    height, width, radiance, asked = 36, 48, 10.0, 0.015
    pixel = 10 * math.tan(math.radians(20)) / height
    left, right, top, bottom = 8.5, 39.5, 9.98, 20.5
    corner = [(left - width / 2) * pixel, (height / 2 - bottom) * pixel, 0]
    scene = make_scene(
        camera={"eye": [0, 0, 5], "look_at": [0, 0, 0], "vertical_fov": 40},
        film={"width": width, "height": height},
        lights=[
            {"type": "rectangle", "corner": corner, "radiance": radiance}
            | {"edge_u": [(right - left) * pixel, 0, 0], "edge_v": [0, (bottom - top) * pixel, 0]}
        ],
    )
    across, down = (
        np.clip(last - np.arange(size), 0, 1) - np.clip(first - np.arange(size), 0, 1)
        for first, last, size in ((left, right, width), (top, bottom, height))
    )
    truth = radiance * np.outer(down, across)
    squares = []
    for seed in range(3):
        picture = render(scene, error=asked, spp=1024, seed=seed, sampler="sobol")
        squares.append(((picture.linear[..., 0] - truth) ** 2).mean())
    assert math.sqrt(np.mean(squares)) < asked
