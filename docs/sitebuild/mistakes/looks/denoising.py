"""Curves over a difference, a ratio of variances, degrees of freedom, a distance, a neighbour's weight and a move."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import curves, label, plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray[Any, Any]

COUNTS = 3.0, 12.0
"""Samples of the two pixels."""


def _rows(x: Array) -> Array:
    return np.tile(x, (3, 1))


def _statistics(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    x = np.linspace(-1, 1, 81)
    one = np.ones_like(x)
    given = _rows(x), _rows(0.9 * one), COUNTS[0] * one, 0 * _rows(x), _rows(3.6 * one)
    curves(axes, x, *(m.welch_t(*given, COUNTS[1] * one)[0] for m in (made, right)))
    label(axes, "difference of the means")


def _of_no_variance(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    """Infinities are drawn as 5."""
    x = np.linspace(-1, 1, 9)
    one = np.full_like(x, 4)
    given = _rows(x), 0 * _rows(x), one, 0 * _rows(x), 0 * _rows(x), one
    found = (np.clip(m.welch_t(*given)[0], -5, 5) for m in (made, right))
    curves(axes, x, *found, drawstyle="steps-mid", marker=".")
    label(axes, "difference of the means")


def _degrees(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    ratio = np.linspace(0, 4, 81)
    one = np.ones_like(ratio)
    given = _rows(ratio), COUNTS[0] * one, _rows(one), COUNTS[1] * one
    curves(axes, ratio, *(m.degrees_of_freedom(*given)[0] for m in (made, right)))
    label(axes, "first variance over the second")


def _degrees_of_none(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    count = np.arange(2.0, 20)
    given = np.zeros((3, count.size)), count, np.zeros((3, count.size)), count
    curves(axes, count, *(m.degrees_of_freedom(*given)[0] for m in (made, right)))
    label(axes, "samples of each pixel, without variance")


def _critical(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    degrees = np.linspace(1, 8, 141)
    curves(axes, degrees, *(m.critical_value(degrees, 0.1) for m in (made, right)))
    label(axes, "degrees of freedom, at the level 0.1")


def _beside_the_end(rows: tuple[float, ...]) -> Any:
    """The first channel's statistic runs past its critical value, 2; the others' stand still."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        x = np.linspace(-5, 5, 21)
        t = np.stack((x, *(np.full_like(x, each) for each in rows)))
        given = t, np.full_like(t, 2), np.full_like(x, 0.5), 1.0
        found = (m.pair_weights(*given) for m in (made, right))
        curves(axes, x, *found, drawstyle="steps-mid", marker=".")
        label(axes, "t of red; critical value 2")

    return draw


def _over_distance(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    x = np.linspace(0, 6, 81)
    given = np.full((3, x.size), 0.5), np.full((3, x.size), 2.0), x, 1.5
    curves(axes, x, *(m.pair_weights(*given) for m in (made, right)))
    label(axes, "distance, pixels")


def _mean(result: int) -> Any:
    """Two neighbours of radiance 1 and 3 and variance 0.5 and 1; the second's weight grows."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        x = np.linspace(0, 2, 41)
        means = np.tile([1.0, 3.0], (3, x.size, 1))
        variances = np.tile([0.5, 1.0], (3, x.size, 1))
        weights = np.stack((np.ones_like(x), x), axis=1)
        found = (m.weighted_mean(means, variances, weights)[result][0] for m in (made, right))
        curves(axes, x, *found)
        label(axes, "weight of the second of two neighbours")

    return draw


def _bias(axes: Axes, made: ModuleType, right: ModuleType) -> None:
    x = np.linspace(-0.6, 0.6, 81)
    rest = np.full_like(_rows(x), 0.06), 0 * _rows(x), np.full_like(_rows(x), 0.1)
    given = _rows(x), *rest, np.full_like(x, 0.7)
    curves(axes, x, *(m.squared_bias(*given)[0] for m in (made, right)))
    label(axes, "how far the pixel was moved")


LOOKS = {
    "welch_t": (
        Look("Statistics of pixels with 3 and 12 samples", plot(_statistics, curve=True)),
        Look(
            "Statistics of pixels whose samples are all the same, cut off at 5",
            plot(_of_no_variance, curve=True),
            ("t_certain_is_equal", "t_always_positive", "t_equal_is_apart"),
        ),
    ),
    "degrees_of_freedom": (
        Look("Degrees of freedom of pixels with 3 and 12 samples", plot(_degrees, curve=True)),
        Look(
            "Degrees of freedom of pixels whose samples are all the same",
            plot(_degrees_of_none, curve=True),
            ("degrees_certain_zero",),
        ),
    ),
    "critical_value": (Look("Critical values at the level 0.1", plot(_critical, curve=True)),),
    "pair_weights": (
        Look(
            "Weights over the statistic of red, green and blue being equal",
            plot(_beside_the_end((0, 0)), curve=True),
        ),
        Look(
            "Weights over the statistic of red, green being over its critical value",
            plot(_beside_the_end((2.6, 0.5)), curve=True),
            ("weights_any", "weights_mean", "weights_first"),
        ),
        Look(
            "Weights over the distance",
            plot(_over_distance, curve=True),
            (
                "weights_no_distance",
                "weights_no_half",
                "weights_not_squared",
                "weights_normalised",
            ),
        ),
    ),
    "weighted_mean": (
        Look("The mean of two neighbours, 1 and 3", plot(_mean(0), curve=True)),
        Look(
            "The variance of the mean of two neighbours",
            plot(_mean(1), curve=True),
            (
                "mean_variance_not_squared",
                "mean_variance_sum",
                "mean_deviation",
                "mean_variance_by_sum",
            ),
        ),
    ),
    "squared_bias": (Look("The squared bias over the move", plot(_bias, curve=True)),),
}
