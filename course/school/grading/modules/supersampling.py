"""supersampling declared: the three patterns of points in pixels, the Gaussian's weights, and the weighted mean."""

from collections.abc import Callable, Mapping
from functools import partial
from math import nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import (
    Arguments,
    Function,
    Law,
    Made,
    count,
    function,
    number,
)
from course.school.grading.checks.distributions import uniform
from course.school.grading.checks.drawing import Draw, worst_units
from course.school.grading.checks.laws import EPSILON, close, exact, from_generator, law, within

# ---------------------------------------------------------------- cells of a pixel

GRID = {"k": count(2, 6, (0, -1)), "n": Made(lambda d: d.n, (-1,))}

SMALLEST = (lambda _: {"k": 1, "n": 0}, lambda _: {"k": 1, "n": 3}, lambda _: {"k": 16, "n": 2})

FEW = 40
"""Pixels, where each is looked at."""


def _cells(k: int) -> Array:
    """Column and row of each cell, (2, 1, k * k): row by row, x fastest."""
    row, column = np.divmod(np.arange(k * k), k)
    return np.stack((column, row)).astype(float)[:, None]


def _by_cell(points: Array, k: int) -> Array:
    """The points of each pixel in the order of the cells that hold them, whatever order they came in."""
    # A point that is rounded to a border may seem to lie in the next cell.
    if np.abs(points * k - _cells(k) - 0.5).max(initial=0) < 0.501:
        return points
    column, row = np.clip(np.floor(points * k), 0, k - 1)
    order = np.argsort(row * k + column, axis=1, kind="stable")
    return np.take_along_axis(points, np.broadcast_to(order, points.shape), axis=2)


def _any_k(draw: Draw) -> Mapping[str, Any]:
    sizes = (2, 3) if draw.simple else (1, 2, 3, 4, 5, 7, 8, 16)
    return {"k": int(draw.rng.choice(sizes))}


def _some_k(draw: Draw) -> Mapping[str, Any]:
    return {"k": int(draw.rng.integers(2, 5))}


def _in_order(a: Arguments, points: Array) -> None:
    """Each point lies nearest to the cell whose turn it is, wherever in that cell."""
    off = np.abs(points * a.k - _cells(a.k) - 0.5)
    if off.max() > 0.75:
        _, pixel, sample = (int(i) for i in np.unravel_index(int(off.argmax()), off.shape))
        x, y = points[:, pixel, sample]
        column, row = _cells(a.k)[:, 0, sample]
        raise Failure(
            f"the point in column {column:.0f} and row {row:.0f} of the cells",
            f"({x:.4g}, {y:.4g})",
            f"k = {a.k}, pixel {pixel}, sample {sample}",
            "Cells come row by row, and within a row x grows first.",
        )


def _one_in_each(a: Arguments, points: Array) -> None:
    inside = _by_cell(points, a.k) * a.k - _cells(a.k)
    off = np.abs(inside - 0.5) - 0.5
    if off.max() > 2 * a.k * EPSILON:
        axis, pixel, cell = (int(i) for i in np.unravel_index(int(off.argmax()), off.shape))
        low = _cells(a.k)[axis, 0, cell]
        raise Failure(
            f"one point in each of the {a.k**2} cells",
            f"none in cell {cell}" if off[axis, pixel, cell] > 0.5 else "one off",
            f"k = {a.k}, pixel {pixel}: the nearest has {'xy'[axis]} = {(inside[axis, pixel, cell] + low) / a.k:.6g}, "
            f"the cell goes from {low / a.k:.6g} to {(low + 1) / a.k:.6g}",
            "A point may go anywhere in its own cell, 1/k wide, and nowhere else.",
        )


INSIDE = within(
    "inside",
    "Points lie in their pixels",
    lambda _, r: r,
    0,
    1,
    "Places in a pixel go from 0 to 1, and the course's samples don't reach 1.",
    what="a coordinate",
    slack=0,
    n=FEW,
)

ORDER = law("order", "Cells come row by row, x fastest", _in_order, case=_some_k, n=FEW)

# ---------------------------------------------------------------- regular

REGULAR = function(
    "supersampling.regular",
    GRID,
    (
        INSIDE,
        ORDER,
        close(
            "centres",
            "Points are the centres of the cells",
            lambda a, r: (_by_cell(r, a.k), (_cells(a.k) + 0.5) / a.k),
            "Each point stands in the middle of its cell; cells are 1/k wide.",
            what="the coordinate of a cell's centre:",
            case=_any_k,
            n=FEW,
            within=4,
            scales=(1.0,) * 3,
            role="core",
        ),
    ),
    corners=SMALLEST,
    speed=1024,
)

# ---------------------------------------------------------------- random and jittered


def _in_cells(a: Arguments, points: Array) -> Array:
    inside: Array = np.clip(_by_cell(points, a.k) * a.k - _cells(a.k), 0, 1)
    return inside


PAIRINGS = np.array(((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2)))
"""Of the four samples of a pixel."""


def _pairs_of_samples(points: Array) -> Array:
    """x, x, y, y of two samples of a pixel: (4, 2 n)."""
    n = points.shape[1]
    paired = np.take_along_axis(points, PAIRINGS[np.arange(n) % 3][None], axis=2)
    return np.moveaxis(paired.reshape(2, n, 2, 2), 3, 1).reshape(4, -1)


def _pairs_of_pixels(points: Array) -> Array:
    """x, x, y, y of the same sample in two neighbouring pixels."""
    n = points.shape[1] // 2
    pairs = points[:, : 2 * n].reshape(2, n, 2, -1)
    return np.moveaxis(pairs, 2, 1).reshape(4, -1)


def _independent(
    places: Callable[[Arguments, Array], Array], whose: str, jitter: str
) -> tuple[Law, ...]:
    """Points fill the unit square, and know nothing of each other, in coordinates (2, n, k * k) that they give."""
    return (
        from_generator(),
        uniform(
            "uniform",
            f"Points are uniform in {whose}",
            lambda a, r: places(a, r).reshape(2, -1),
            (16, 16),
            "Both coordinates need numbers of their own, and these need to fill [0, 1).",
            what="places",
            case=_some_k,
            n=4000,
        ),
        uniform(
            "samples",
            f"{jitter} independent",
            lambda a, r: _pairs_of_samples(places(a, r)),
            (4, 4, 4, 4),
            "Each sample of a pixel needs random numbers of its own.",
            what="x, x, y and y of two samples of a pixel",
            case=lambda _: {"k": 2},
            n=6000,
        ),
        uniform(
            "pixels",
            "Pixels are independent of each other",
            lambda a, r: _pairs_of_pixels(places(a, r)),
            (4, 4, 4, 4),
            "Each pixel needs random numbers of its own.",
            what="x, x, y and y of a sample in two neighbouring pixels",
            case=_some_k,
            n=6000,
        ),
    )


def _habits(points: Array) -> Array:
    """What tells how points were drawn, in the order in which they came, each in coordinates of its place.

    Where all pixels are alike the few numbers that there are tell nothing but whether points are in their places.
    """
    x, y = points
    alike = (points == np.roll(points, 1, axis=1)).all(axis=0)
    same_cells = np.abs(x - np.roll(x, 1, axis=1)) < 1e-4
    in_place = (np.abs(points - 0.5) < 0.501).all(axis=0)
    rows = [np.where(alike, -8 - in_place, row).ravel() for row in (x, y, x - y)]
    return np.stack((*rows, same_cells.ravel()))


RANDOM = function(
    "supersampling.random",
    GRID,
    (INSIDE, *_independent(lambda _, r: r, "the pixel", "A pixel's samples are")),
    corners=SMALLEST,
    features=lambda _, r: _habits(r),
    speed=1024,
)

JITTERED = function(
    "supersampling.jittered",
    GRID,
    (
        INSIDE,
        law(
            "cells",
            "Each cell holds one point",
            _one_in_each,
            case=_any_k,
            n=FEW,
            scales=(1.0,) * 3,
            role="core",
        ),
        ORDER,
        *_independent(_in_cells, "their cells", "The jitter of cells is"),
    ),
    corners=SMALLEST,
    features=lambda a, r: _habits(r * a.k - _cells(a.k)),
    speed=1024,
)

# ---------------------------------------------------------------- gaussian_weights


def _offsets(draw: Draw) -> Mapping[str, Any]:
    s = int(draw.rng.integers(1, 4 if draw.simple else 9))
    return {"offsets": draw.units(2, draw.n * s).reshape(2, draw.n, s)}


def _near_centre(draw: Draw) -> Mapping[str, Any]:
    """Offsets as far from the centre as sigma is wide, if the pixel is as large."""
    offsets = 0.5 + draw.scale * draw.rng.uniform(-2, 2, (2, draw.n, 6))
    offsets[:, :, 0] = 0.5
    return {"offsets": np.clip(offsets, 0, 0.99), "sigma": draw.scale}


def _gaussian(a: Arguments, sigma: float) -> Array:
    x, y = (a.offsets - 0.5) / sigma
    return np.asarray(np.exp(-(x**2 + y**2) / 2))


def _weights(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, _gaussian(a, a.sigma), 1.0


HINT = "It is 1 in the pixel's middle and falls with the squared distance from there."


def _by_default(function: Function, trial: Trial) -> None:
    a = function.make(Draw(trial.rng, 100))
    found = function.seen(trial.call(a.offsets), a)
    expected = _gaussian(exact(a), 1 / 6)
    off = np.abs(found - expected)
    if off.max() > 16 * EPSILON:
        worst = np.unravel_index(int(off.argmax()), off.shape)
        x, y = a.offsets[:, *worst]
        raise Failure(
            f"without sigma the weight for 1/6, {expected[worst]:.4g}",
            f"{found[worst]:.4g}",
            f"one sample with offsets ({x:.4g}, {y:.4g})",
            "Three sigma reach from the pixel's middle to its edge.",
        )


GAUSSIAN_WEIGHTS = function(
    "supersampling.gaussian_weights",
    {"sigma": number(0.12, 3, (0.0, -0.5, nan))},
    (
        Law("default", "Sigma is 1/6 by default", _by_default),
        close(
            "extremes",
            "Weights are right for the smallest and the largest sigma",
            _weights,
            HINT,
            what="a weight of",
            case=_near_centre,
            scales=(1e-6, 1e-3, 1e3, 1e6),
        ),
        close(
            "formula",
            "Weights are the Gaussian",
            _weights,
            HINT,
            what="a weight of",
            scales=(1.0,) * 3,
            role="core",
        ),
    ),
    case=_offsets,
    corners=(
        lambda dtype: {"offsets": worst_units(2, dtype)[:, None]},
        lambda dtype: {"offsets": np.zeros((2, 3, 0), dtype)},
    ),
    speed=1024,
)

# ---------------------------------------------------------------- resolve


def _samples(draw: Draw, s: int | None = None) -> Mapping[str, Any]:
    """Radiance from 0 to 1, and weights that are all over 0."""
    if s is None:
        s = int(draw.rng.integers(2, 4 if draw.simple else 9))
    return {
        "radiance": draw.uniform(0, 1, 3, draw.n, s),
        "weights": draw.uniform(0.01, 1, draw.n, s),
    }


def _bright(draw: Draw) -> Mapping[str, Any]:
    """Radiance of any size and sign."""
    given = _samples(draw)
    return {**given, "radiance": draw.lengths(-2, 6, *given["radiance"].shape)}


def _of_any_scale(draw: Draw) -> Mapping[str, Any]:
    given = _samples(draw)
    return {**given, "weights": given["weights"] * 10.0 ** draw.rng.integers(-15, 6, (draw.n, 1))}


def _some_negative(draw: Draw) -> Mapping[str, Any]:
    """Weights as those of a filter with lobes below 0; of every other pixel the sum is, too."""
    given = _samples(draw)
    weights = 0.5 + given["weights"]
    weights[:, 0] = -draw.uniform(0, 0.4, draw.n)
    weights[1::2] *= -1
    return {**given, "weights": weights}


def _some_zero(draw: Draw) -> Mapping[str, Any]:
    """In every third pixel all weights are 0, and in another third they cancel each other."""
    given = _samples(draw, 6)
    given["weights"][0::3] = 0
    given["weights"][1::3] = (1, -1, 2, -2, 0.5, -0.5)
    return given


def _ordinary(draw: Draw) -> Mapping[str, Any]:
    """Hardly any pixel has weights of 0."""
    given = _samples(draw)
    given["weights"][10::40] = 0
    return given


def _mean(a: Arguments, r: Array) -> tuple[Any, ...]:
    """What came, the weighted mean, and what rounding is as large as."""
    total = a.weights.sum(axis=1, keepdims=True)
    weights = np.where(total == 0, 1, a.weights)
    total = weights.sum(axis=1)
    largest = np.abs(a.radiance).max(axis=(0, 2)) * np.abs(weights).sum(axis=1) / np.abs(total)
    return r, (a.radiance * weights).sum(axis=2) / total, largest


_resolved = partial(close, compare=_mean, what="a weighted mean of", within=32)


RESOLVE = function(
    "supersampling.resolve",
    {},
    (
        close(
            "no-samples",
            "No samples give black",
            lambda _, r: (r, 0.0),
            "Without samples no light has been seen.",
            what="without samples,",
            case=lambda d: _samples(d, 0),
        ),
        _resolved(
            "zero-weights",
            "Where weights sum to zero the plain mean is taken",
            what="where weights sum to zero, a plain mean of, and elsewhere a weighted one of",
            hint="Where the weights of a pixel sum to zero, and only there, all samples count alike.",
            case=_some_zero,
        ),
        _resolved(
            "scale",
            "The weights' scale does not matter",
            hint="Weights that are all a hundred times larger or smaller mean the same.",
            case=_of_any_scale,
        ),
        _resolved(
            "negative-weights",
            "Weights may be negative",
            hint="A filter may have lobes below 0: such a sample is taken away from the others.",
            case=_some_negative,
        ),
        _resolved(
            "bright",
            "Radiance may have any size and sign",
            hint="Radiance is light, not a screen's colour: lamps are far brighter than 1.",
            case=_bright,
            scales=(1.0, 1e-3, 1e3, 1e5),
            points=0.5,
            role="core",
        ),
        _resolved(
            "mean",
            "Samples count by their weights",
            hint="Samples count by their weights, and equal samples give their own colour.",
            case=_samples,
            role="core",
        ),
    ),
    case=_ordinary,
    corners=(
        lambda dtype: {"radiance": np.ones((3, 4, 0), dtype), "weights": np.ones((4, 0), dtype)},
        lambda dtype: {"radiance": np.ones((3, 4, 1), dtype), "weights": np.ones((4, 1), dtype)},
        lambda dtype: {"radiance": np.ones((3, 4, 2), dtype), "weights": np.zeros((4, 2), dtype)},
    ),
    speed=1024,
)

FUNCTIONS = (REGULAR, RANDOM, JITTERED, GAUSSIAN_WEIGHTS, RESOLVE)
