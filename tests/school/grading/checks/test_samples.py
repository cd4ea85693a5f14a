"""The smallest sample that shows a wrong distribution: counted by hand, and none where the distribution is right."""

import numpy as np
import pytest

from course.school.grading.checks.distributions import crowded, feature_names, off_mean


def test_points_at_one_place_are_told_with_the_fewest() -> None:
    """In a quarter five of twenty are expected; in a half 29 points that are all there are the fewest."""
    at = np.full((1, 500), 0.3)
    told = "the first 20 points: 5 expected with x from 0.25 to 0.5, 20 came"
    assert crowded(at, "x") == told


def test_features_that_hang_together_are_told_by_both() -> None:
    x = (np.arange(2000) * 0.6180339887) % 1
    told = crowded(np.stack((x, x)), "x and y")
    assert " and y from " in told
    assert told.startswith("the first ")


def test_what_is_right_shows_nothing() -> None:
    """The seed is fixed; a box is told for none of 150 seeds."""
    values = np.random.default_rng(1).random((2, 20_000))
    assert not crowded(values, "x and y")
    assert not off_mean(values[0], 0.5, 1 / 12, "mean of x")


def test_a_mean_that_is_off_is_told_with_thirty_values_at_least() -> None:
    told = "the first 30 points: mean of x 0.5 expected, 1 came"
    assert off_mean(np.ones(99), 0.5, 1 / 12, "mean of x") == told


@pytest.mark.parametrize(
    ("what", "rows", "names"),
    [
        ("r^2 and turn", 2, ["r^2", "turn"]),
        ("x, x, y and y of two samples", 4, ["x", "x", "y", "y of two samples"]),
        ("share of each direction, and turn", 2, ["share of each direction", "turn"]),
        ("places", 2, ["number 1 of places", "number 2 of places"]),
        ("radius and turn", 1, ["radius and turn"]),
    ],
)
def test_features_have_the_names_of_what_they_are_called_together(
    what: str, rows: int, names: list[str]
) -> None:
    assert feature_names(what, rows) == names
