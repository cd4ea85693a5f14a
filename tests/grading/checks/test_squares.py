"""Squares made by hand are seen as they are, and each mistake is told from the others."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from course.grading.checks import squares
from course.grading.checks.check import Array, Failure
from course.grading.checks.vectors import normalized
from tests.grading.checks.by_hand import trial_of

AXIS = normalized(np.array([[1.0], [2.0], [-2.0]]))[:, 0]
ACROSS = np.array([[2.0, 2.0], [1.0, -2.0], [2.0, -1.0]]) / 3
ROUGHNESS = 0.6


GRID = (np.indices((20, 20)).reshape(2, -1) + 0.5) / 20


def square(
    warp: Callable[[Array], Array] = lambda u: u - 0.5, u: Array = GRID, *, unit: bool = True
) -> squares.Square:
    """Of side 0.6, where ``warp`` takes numbers (2, N) to places in the square of side 1."""
    jittered = AXIS[:, None] + ROUGHNESS * ACROSS @ warp(u)
    return squares.seen(AXIS, u, normalized(jittered) if unit else jittered)


RIGHT = {"right": square(), "mirrored": square(lambda u: 0.5 - u[::-1])}
WRONG = {
    squares.one_sided: square(lambda u: u),
    squares.twice_as_wide: square(lambda u: 2 * u - 1),
    squares.one_number: square(lambda u: u[[0, 0]] - 0.5),
    squares.not_normalised: square(unit=False),
}


def test_a_square_is_seen_as_it_is() -> None:
    seen = square(lambda u: u - np.array([[0.25], [0.5]]))
    assert np.abs(seen.sides - ROUGHNESS * ACROSS).max() < 1e-12
    assert np.abs(seen.centre - 0.25 * ROUGHNESS * ACROSS[:, 0]).max() < 1e-12
    assert np.abs(seen.rest).max() < 1e-12
    assert np.abs(seen.lengths - 1).max() < 1e-12
    assert seen.off_centre() == pytest.approx(0.15)
    corner = AXIS + ROUGHNESS * ACROSS @ (0.75, 0.5)
    assert np.abs(seen.at(np.ones((2, 1)))[:, 0] - corner).max() < 1e-12


def test_what_never_meets_the_plane() -> None:
    with pytest.raises(
        Failure, match=r"to stay in front.*direction = \(0\.333333, 0\.666667, -0\.66"
    ):
        squares.seen(AXIS, np.zeros((2, 3)), np.repeat(-AXIS[:, None], 3, axis=1))


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_square_passes_however_it_is_turned(name: str) -> None:
    squares.check_square(RIGHT[name], ROUGHNESS)
    assert not any(mistake(RIGHT[name], ROUGHNESS) for mistake in WRONG)


@pytest.mark.parametrize("made", WRONG, ids=lambda made: made.__name__)
def test_each_mistake_is_told_from_the_others(made: Callable[..., bool]) -> None:
    told = [mistake for mistake in WRONG if mistake(WRONG[made], ROUGHNESS)]
    assert told == [made]


@pytest.mark.parametrize(
    ("warp", "told"),
    [
        (lambda u: u, "centre's distance from the direction 0 within"),
        (lambda u: (u - 0.5) * [[1.001], [1.0]], "length of the first side 0.6"),
        (lambda u: (u - 0.5) * [[1.0], [0.999]], "length of the second side 0.6"),
        (
            lambda u: np.array([[1.0, 0.6], [0.0, 0.8]]) @ (u - 0.5),
            "product of the sides 0 within .*found 0.36 ",
        ),
        # On a grid around 1/2 the product of both numbers has neither a mean nor a slope.
        (
            lambda u: u - 0.5 + 0.1 * (u - 0.5).prod(axis=0),
            "offset from the place of u in the square",
        ),
    ],
)
def test_what_is_wrong_with_a_square_is_told(warp: Callable[[Array], Array], told: str) -> None:
    with pytest.raises(Failure, match=told):
        squares.check_square(square(warp), ROUGHNESS)


def test_a_square_has_to_be_filled() -> None:
    """One comparison of FALSE_FAIL = 1e-7, with a fixed seed."""
    trial = trial_of()
    u = trial.rng.random((2, 5000))
    squares.check_filled(trial, square(u=u), ROUGHNESS)
    assert [figure.title for figure in trial.figures] == ["where yours meet the square"]
    for warp, told in (
        (lambda u: u[[0, 0]] - 0.5, "a square of side 0.6, found sides of"),
        (lambda u: 1.1 * (u - 0.5), r"all offsets within \+-0.3 along both sides"),
        (lambda u: np.sin(np.pi * (u - 0.5)) / 2, "places in the square: chi-squared"),
    ):
        with pytest.raises(Failure, match=told):
            squares.check_filled(trial, square(warp, u), ROUGHNESS)
