"""Shifts, blurs, spots and more: each is found in all of 4 seeds, in a long run of 20, and said to be what it is.

What was done to a picture is known here, for it was done here: truth and noise are made without the product. The
p-values of differences that are there are far below the level, so no seed is a matter of luck.
"""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from course.engine.comparing.seen import seen
from course.engine.comparing.significance import SIGNIFICANCE, Comparison, compare
from course.engine.comparing.windows import Window
from tests.lengths import LONG, fewer

Array = NDArray[np.float64]
HEIGHT, WIDTH = 96, 128
SEEDS = 20 if LONG else 4
"""For what is there."""

ALARMS = 20
"""Pairs that show nothing."""
SIGMA = 0.03
"""Of the noise of each picture where nothing else is said."""

Y, X = np.mgrid[:HEIGHT, :WIDTH]
SMOOTH = np.stack([0.3 + 0.2 * np.sin(X / k) * np.cos(Y / 13) for k in (7, 9, 11)], axis=2)
CHECKS = np.where((X - 64) ** 2 + (Y - 48) ** 2 < 900, 0.9, 0.2 + 0.5 * ((X // 17 + Y // 13) % 2))
EDGES = CHECKS[..., None] * (1, 0.8, 0.6)
SOFT = gaussian_filter(EDGES, (1.5, 1.5, 0))
TRUTHS = pytest.mark.parametrize("truth", [SMOOTH, EDGES], ids=["smooth", "edges"])


def noisy(picture: Array, rng: np.random.Generator, sigma: float) -> NDArray[np.float32]:
    return (picture + sigma * rng.standard_normal(picture.shape)).astype(np.float32)


def compared(
    one: Array, other: Array, sigma: float = SIGMA, seeds: int = SEEDS
) -> list[Comparison]:
    """Two true pictures with independent noise, by each seed."""
    rngs = map(np.random.default_rng, range(seeds))
    return [compare(noisy(one, rng, sigma), noisy(other, rng, sigma)) for rng in rngs]


def assert_all_found(found: list[Comparison], *words: str) -> None:
    for one in found:
        assert one.p_value < SIGNIFICANCE
        first = str(seen(one, SIGNIFICANCE)[0])
        assert all(word in first for word in words), first


def root_mean_square(values: Array) -> float:
    return float(np.sqrt((values**2).mean()))


@fewer
@TRUTHS
@pytest.mark.parametrize(
    ("across", "down", "words"),
    [(1, 0, "1 pixel to the right"), (-1, 0, "1 pixel to the left"), (0, 1, "1 pixel down")],
)
def test_a_shift_by_a_pixel_is_found(truth: Array, across: int, down: int, words: str) -> None:
    """What it changes is three times as large as the noise."""
    moved = np.roll(truth, (down, across), (0, 1))
    sigma = root_mean_square(moved - truth) / 3
    assert_all_found(compared(moved, truth, sigma), f"A is moved by about {words}")


@TRUTHS
def test_a_shift_by_half_a_pixel_is_found(truth: Array) -> None:
    half = 0.5 * (truth + np.roll(truth, -1, 0))
    sigma = root_mean_square(half - truth) / 3
    assert_all_found(compared(half, truth, sigma), "A is moved by about 0.5 pixels up")


@TRUTHS
def test_a_blur_by_a_pixel_is_found(truth: Array) -> None:
    blurred = gaussian_filter(truth, (1, 1, 0))
    sigma = root_mean_square(blurred - truth) / 3
    assert_all_found(compared(blurred, truth, sigma), "A is blurrier by about", "pixel")
    assert_all_found(compared(truth, blurred, sigma), "A is sharper by about", "pixel")


@pytest.mark.parametrize(
    ("truth", "seeds"),
    [(SMOOTH, SEEDS), (EDGES, SEEDS), (SOFT, 3)],
    ids=["smooth", "edges", "soft edges"],
)
def test_a_picture_that_was_blurred_with_its_noise_is_found(truth: Array, seeds: int) -> None:
    """Of soft edges the difference is smooth itself, as if neighbours shared noise."""
    for seed in range(seeds):
        rng = np.random.default_rng(seed)
        sharp, other = (noisy(truth, rng, 0.001) for _ in range(2))
        found = compare(sharp, gaussian_filter(other, (1, 1, 0)))
        assert_all_found([found], "A is sharper")


@pytest.mark.parametrize("axis", [0, 1], ids=["row", "column"])
def test_one_line_that_is_moved_along_itself_is_found(axis: int) -> None:
    """What it changes is three times as large as the noise."""
    for seed in range(SEEDS):
        rng = np.random.default_rng(seed)
        picture = np.swapaxes(SMOOTH, 0, axis).copy()
        line = int(rng.integers(len(picture)))
        change = np.roll(picture[line], 1, axis=0) - picture[line]
        picture[line] += change
        picture = np.swapaxes(picture, 0, axis)
        sigma = root_mean_square(change) / 3
        found = compare(noisy(picture, rng, sigma), noisy(SMOOTH, rng, sigma))
        assert found.p_value < SIGNIFICANCE
        words = (
            f"right in {WIDTH} x 1 pixels at (0, {line})",
            f"down in 1 x {HEIGHT} pixels at ({line}, 0)",
        )
        assert words[axis] in str(seen(found, SIGNIFICANCE)[0])


def test_a_blur_of_straight_edges_is_found() -> None:
    """Beside an edge the mean of the four neighbours is the same on both sides, and says nothing."""
    edges = np.broadcast_to(0.2 + 0.6 * (X // 16 % 2)[..., None], (HEIGHT, WIDTH, 3))
    blurred = gaussian_filter(edges, (0, 0.5, 0))
    assert_all_found(compared(blurred, edges, 0.1, 5), "A is blurrier")


def test_the_border_of_a_much_noisier_picture_is_no_difference() -> None:
    """A slope there by the pixel itself leans to one side; 20 pairs are alarms once in 500 runs at most."""
    for seed in range(ALARMS):
        rng = np.random.default_rng(seed)
        found = compare(noisy(SMOOTH, rng, SIGMA), noisy(SMOOTH, rng, SIGMA / 20))
        assert found.p_value > 0.05


Change = Callable[[Array, np.random.Generator], Window]


def square(side: int, sigmas: float, channels: slice = slice(None)) -> Change:
    """Anywhere in a picture."""

    def change(picture: Array, rng: np.random.Generator) -> Window:
        place = Window(
            int(rng.integers(WIDTH - side)), int(rng.integers(HEIGHT - side)), side, side
        )
        picture[(*place.pixels, channels)] += sigmas * SIGMA
        return place

    return change


@fewer
@TRUTHS
@pytest.mark.parametrize(
    "change",
    [square(3, 50), square(5, 50), square(7, 50), square(16, 2), square(16, -2, slice(1, 2))],
    ids=["3 at 50", "5 at 50", "7 at 50", "16 at 2", "16 at -2, green"],
)
def test_a_square_is_found_where_it_is(truth: Array, change: Change) -> None:
    for seed in range(SEEDS):
        rng = np.random.default_rng(seed)
        picture = truth.copy()
        place = change(picture, rng)
        found = compare(noisy(picture, rng, SIGMA), noisy(truth, rng, SIGMA))
        assert found.p_value < SIGNIFICANCE
        first = seen(found, SIGNIFICANCE)[0]
        assert first.place is not None
        assert first.place.meets(place)
        darker = picture.sum() < truth.sum()
        assert ("A is darker by" if darker else "A is brighter by") in first.text
        assert ("in green" in first.text) == darker


def test_several_spots_do_not_hide_each_other() -> None:
    for seed in range(SEEDS):
        rng = np.random.default_rng(seed)
        picture = SMOOTH.copy()
        for _ in range(6):
            square(3, 50)(picture, rng)
        found = compare(noisy(picture, rng, SIGMA), noisy(SMOOTH, rng, SIGMA))
        assert found.p_value < SIGNIFICANCE


@TRUTHS
def test_two_percent_in_a_square_are_told(truth: Array) -> None:
    """The square holds whole windows of 16 pixels; at its rim less is seen."""
    picture = truth.copy()
    picture[20:60, 30:70] *= 1.02
    for one in compared(picture, truth, 0.005):
        first = seen(one, SIGNIFICANCE)[0]
        assert first.place is not None
        assert first.place.meets(Window(30, 20, 40, 40))
        assert 1.0 < float(first.text.split("by ")[1].split("%")[0]) < 3.0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda t: 1.02 * t, "A is brighter by 2%"),
        (lambda t: 0.5 * t, "A is darker by 50%"),
        (lambda t: t * (1.03, 1, 1), "A is brighter by 3% in red"),
        (lambda t: t * (1.03, 1, 0.97), "A is brighter by 3% in red, darker by 3% in blue"),
        (lambda t: t[:, ::-1], "A is B flipped left to right"),
        (lambda t: t[::-1], "A is B flipped upside down"),
        (lambda t: t[::-1, ::-1], "A is B turned by 180 degrees"),
    ],
)
def test_what_is_done_to_a_whole_picture_is_told(
    change: Callable[[Array], Array], words: str
) -> None:
    assert_all_found(compared(change(SMOOTH), SMOOTH, 0.005, 3), words)


def test_equal_pictures_show_nothing() -> None:
    """Twenty pairs give a false alarm in one of 500 runs at most; the seeds are fixed."""
    for one in compared(EDGES, EDGES, seeds=ALARMS):
        assert seen(one, SIGNIFICANCE) == []


def test_signs_of_noise_reach_t_as_seldom_as_the_bound_says() -> None:
    """Against all 2^16 signs of sixteen numbers, which are counted here."""
    from course.engine.comparing.windows import p_value

    numbers = np.random.default_rng(3).exponential(1, 16)
    signs = 1 - 2 * (np.arange(2**16)[:, None] >> np.arange(16) & 1)
    t = np.abs(signs @ numbers) / np.sqrt((numbers**2).sum())
    for level in np.linspace(0.5, 3.5, 13):
        assert (t >= level).mean() <= p_value(level)
    assert p_value(3) < 0.01
