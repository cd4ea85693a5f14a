"""Checks of supersampling: the patterns, the Gaussian weights and the weighted mean.

Whatever a check asks of the values, it asks in float64 of any floating dtype: a wrong dtype costs the contract alone.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_seeded,
    check_untouched,
    contract_checks,
    finite_floats,
    worst_units,
)
from course.grading.checks.statistics import check_uniform, distribution_check

EPS = 2.0**-23
"""Of float32: the tolerances hold for both dtypes."""

# ---------------------------------------------------------------- what the checks share


def _draw(trial: Trial, k: int, n: int) -> Array:
    """A random pattern's points, in float64."""
    points = finite_floats(trial.call(k, n, trial.generator()), (2, n, k * k), "the points")
    trial.show("points", "Your points, all pixels in one", yours=points.reshape(2, -1)[:, :2000])
    return points


def _cells(k: int) -> Array:
    """Column and row of each cell, (2, 1, k * k): row by row, x fastest."""
    row, column = np.divmod(np.arange(k * k), k)
    return np.stack((column, row)).astype(float)[:, None]


def _by_cell(points: Array, k: int) -> Array:
    """The points of each pixel in the order of the cells that hold them, whatever order they came in."""
    by_columns = np.arange(k * k).reshape(k, k).T.ravel()
    for turned in (points, points[:, :, by_columns]):
        # A point that is rounded to a border may seem to lie in the next cell.
        if np.abs(turned * k - _cells(k) - 0.5).max() < 0.501:
            return turned
    column, row = np.clip(np.floor(points * k), 0, k - 1)
    order = np.argsort(row * k + column, axis=1, kind="stable")
    return np.take_along_axis(points, np.broadcast_to(order, points.shape), axis=2)


def _check_in_pixel(points: Array) -> None:
    outside = (points < 0) | (points > 1)
    if outside.any():
        index = tuple(int(i) for i in np.argwhere(outside)[0])
        raise Failure("points within [0, 1)", f"{points[index]:.6g}", f"at index {index}")


# ---------------------------------------------------------------- all three patterns


def _pattern_arguments(trial: Trial, k: int, n: int) -> tuple[Any, ...]:
    return (k, n) if trial.function == "regular" else (k, n, trial.generator())


def _pattern_contract(trial: Trial) -> None:
    some, many = (int(x) for x in trial.rng.integers((2, 5), (6, 12)))
    for k, n in ((some, many), (1, many), (some, 1), (some, 0), (1, 0)):
        value = trial.call(*_pattern_arguments(trial, k, n))
        _check_in_pixel(check_array(value, (2, n, k * k), np.float32, f"k = {k}, n = {n}: points"))


def _pattern_untouched(trial: Trial) -> None:
    check_untouched(trial, *_pattern_arguments(trial, 3, 4))


def _pattern_refuses(trial: Trial) -> None:
    for k, n, named in ((0, 2, "k"), (-1, 2, "k"), (2, -1, "n")):
        check_refused(trial, *_pattern_arguments(trial, k, n), named=f"{named} (k = {k}, n = {n})")


# ---------------------------------------------------------------- regular


def _regular_centres(trial: Trial) -> None:
    for k in (1, int(trial.rng.integers(2, 9)), 16):
        points = finite_floats(trial.call(k, 3), (2, 3, k * k), "the points")
        trial.show("points", f"Your points, k = {k}", yours=points[:, 0, :2000])
        check_close(
            _by_cell(points, k),
            np.broadcast_to((_cells(k) + 0.5) / k, points.shape),
            4 * EPS,
            f"k = {k}: the coordinate of a cell's centre",
            hint="Each point stands in the middle of its cell; cells are 1/k wide.",
        )


def _check_order(points: Array, k: int) -> None:
    """Each point lies nearest to the cell whose turn it is, wherever in that cell."""
    off = np.abs(points * k - _cells(k) - 0.5)
    if off.max() > 0.75:
        _, pixel, sample = (int(i) for i in np.unravel_index(int(off.argmax()), off.shape))
        x, y = points[:, pixel, sample]
        column, row = _cells(k)[:, 0, sample]
        raise Failure(
            f"the point in column {column:.0f} and row {row:.0f} of the cells",
            f"({x:.4g}, {y:.4g})",
            f"k = {k}, pixel {pixel}, sample {sample}",
            "Cells come row by row, and within a row x grows first.",
        )


def _regular_order(trial: Trial) -> None:
    k = int(trial.rng.integers(3, 9))
    _check_order(finite_floats(trial.call(k, 3), (2, 3, k * k), "the points"), k)


# ---------------------------------------------------------------- random and jittered


def _seeded(trial: Trial) -> None:
    check_seeded(trial, lambda rng: finite_floats(trial.call(3, 20, rng), (2, 20, 9), "the points"))


def _within(points: Array, k: int) -> Array:
    """Jittered points in coordinates of their cells, whatever their order; others as they are."""
    inside: Array = np.clip(_by_cell(points, k) * k - _cells(k), 0, 1)
    return inside


def _shared(trial: Trial) -> tuple[Array, int]:
    """A random pattern's points in coordinates in which they are uniform and independent, and k."""
    k = int(trial.rng.integers(2, 5))
    points = _draw(trial, k, 20_000 // k**2 // 2 * 2)
    return (_within(points, k) if trial.function == "jittered" else points), k


def _uniform(trial: Trial) -> None:
    points, k = _shared(trial)
    where = "in their cells" if trial.function == "jittered" else "in the pixel"
    check_uniform(
        points.reshape(2, -1),
        (16, 16),
        f"points even {where}, k = {k}",
        "Both coordinates need numbers of their own, and these need to fill [0, 1).",
    )


def _samples(trial: Trial) -> None:
    points = _draw(trial, 2, 5000)
    if trial.function == "jittered":
        points = _within(points, 2)
    a, b, c = (int(i) for i in trial.rng.permutation(4)[:3])
    for i, j, first, second in ((a, b, 0, 0), (b, c, 1, 1), (a, c, 0, 1), (c, b, 0, 1)):
        check_uniform(
            np.stack((points[first, :, i], points[second, :, j])),
            (8, 8),
            f"{'xy'[first]} of sample {i} independent of {'xy'[second]} of sample {j}",
            "Each sample of a pixel needs random numbers of its own.",
        )


def _pixels(trial: Trial) -> None:
    points, _ = _shared(trial)
    for second in (0, 1):
        check_uniform(
            np.stack((points[0, 0::2].ravel(), points[second, 1::2].ravel())),
            (8, 8),
            f"x in a pixel independent of {'xy'[second]} in the next",
            "Each pixel needs random numbers of its own.",
        )


def _jittered_cells(trial: Trial) -> None:
    for k in (1, int(trial.rng.integers(2, 7)), 16):
        points = _draw(trial, k, 100 if k < 16 else 10)
        inside = _by_cell(points, k) * k - _cells(k)
        off = np.abs(inside - 0.5) - 0.5
        if off.max() > 2 * k * EPS:
            axis, pixel, cell = (int(i) for i in np.unravel_index(int(off.argmax()), off.shape))
            raise Failure(
                f"one point in each of the {k * k} cells",
                f"none in cell {cell}" if abs(inside[axis, pixel, cell] - 0.5) > 1 else "one off",
                f"k = {k}, pixel {pixel}: the nearest has {'xy'[axis]} = "
                f"{(inside[axis, pixel, cell] + _cells(k)[axis, 0, cell]) / k:.6g}, the cell goes "
                f"from {_cells(k)[axis, 0, cell] / k:.6g} to {(_cells(k)[axis, 0, cell] + 1) / k:.6g}",
                "A point may go anywhere in its own cell, 1/k wide, and nowhere else.",
            )


def _jittered_order(trial: Trial) -> None:
    k = int(trial.rng.integers(3, 7))
    _check_order(_draw(trial, k, 20), k)


# ---------------------------------------------------------------- gaussian_weights


def _gaussian(offsets: Array, sigma: float) -> Array:
    x, y = offsets.astype(float) - 0.5
    return np.asarray(np.exp((x**2 + y**2) / (-2 * sigma**2)))


def _offsets(trial: Trial, dtype: Any = np.float32) -> Array:
    """Offsets in 40 pixels, the first of them a pixel's centre, its corner and its edges."""
    offsets = trial.rng.random((2, 40, 9), dtype)
    offsets[:, 0, :4] = ((0.5, 0, 0.5, 0), (0.5, 0, 0, 0.5))
    return offsets


def _sigma(trial: Trial) -> float:
    return float(trial.rng.uniform(0.12, 0.3))


def _gaussian_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        offsets = _offsets(trial, dtype)
        check_array(trial.call(offsets), (40, 9), dtype)
        for scalar in (_sigma(trial), np.float64(0.25), np.float32(0.25)):
            what = f"weights for sigma a {type(scalar).__name__}"
            check_array(trial.call(offsets, scalar), (40, 9), dtype, what)
        ends = worst_units(2, dtype)[:, None]
        check_array(trial.call(ends), (1, 25), dtype, "weights at the pixel's edges")
        for n, s in ((0, 4), (3, 0), (0, 0)):
            check_array(trial.call(np.zeros((2, n, s), dtype)), (n, s), dtype)


def _gaussian_untouched(trial: Trial) -> None:
    check_untouched(trial, _offsets(trial), 0.25)


def _gaussian_refuses(trial: Trial) -> None:
    for sigma in (0.0, -0.5, float("nan")):
        check_refused(trial, np.zeros((2, 3, 4), np.float32), sigma, named=f"sigma ({sigma})")
    for shape in ((2, 5), (3, 4, 5), (4, 5, 2)):
        check_refused(trial, np.zeros(shape, np.float32), 0.25, named=f"shape of offsets {shape}")


def _check_gaussian(weights: Any, offsets: Array, sigma: float) -> None:
    found = finite_floats(weights, offsets.shape[1:], "the weights")
    expected = _gaussian(offsets, sigma)
    columns = offsets.reshape(2, -1)
    check_close(
        found.ravel(),
        expected.ravel(),
        16 * EPS,
        f"sigma = {sigma:.6g}: a weight of",
        at(offset=columns, r=np.hypot(*(columns.astype(float) - 0.5))),
        "It is 1 in the pixel's middle and falls with the squared distance from there.",
    )


def _gaussian_formula(trial: Trial) -> None:
    for dtype in DTYPES:
        for sigma in (_sigma(trial), float(trial.rng.uniform(0.4, 3))):
            offsets = _offsets(trial, dtype)
            _check_gaussian(trial.call(offsets, sigma), offsets, sigma)


def _gaussian_default(trial: Trial) -> None:
    offsets = _offsets(trial)
    _check_gaussian(trial.call(offsets), offsets, 1 / 6)


def _gaussian_extremes(trial: Trial) -> None:
    for dtype in DTYPES:
        offsets = np.array([[[0.5, 0.1, 0.9, 0.5]], [[0.5, 0.5, 0.2, 0.75]]], dtype)
        for sigma in (1e-300, 1e-30, 1e-12, 1e12, 1e30, 1e300):
            weights = finite_floats(
                trial.call(offsets, sigma), (1, 4), f"sigma = {sigma}: the weights"
            )
            check_close(
                weights,
                np.array([[1.0, *[float(sigma > 1)] * 3]]),
                16 * EPS,
                f"sigma = {sigma}: a weight of",
                hint="However small or large sigma is, its square must not vanish or overflow.",
            )


# ---------------------------------------------------------------- resolve


def _samples_of(trial: Trial, dtype: Any = np.float32) -> tuple[Array, Array]:
    """Radiance and weights of 30 pixels with 8 samples each."""
    radiance, weights = trial.rng.random((3, 30, 8), dtype), trial.rng.random((30, 8), dtype)
    return radiance, weights + dtype(0.01)


def _mean(radiance: Array, weights: Array) -> Array:
    weights = weights.astype(float)
    return np.asarray((radiance * weights).sum(axis=2) / weights.sum(axis=1))


def _resolve_contract(trial: Trial) -> None:
    for one in DTYPES:
        for other in DTYPES:
            radiance, _ = _samples_of(trial, one)
            _, weights = _samples_of(trial, other)
            what = f"the mean of {radiance.dtype} radiance with {weights.dtype} weights"
            dtype = np.promote_types(one, other)
            check_array(trial.call(radiance, weights), (3, 30), dtype, what)
            for n, s in ((0, 4), (1, 1), (0, 0)):
                arrays = np.ones((3, n, s), one), np.ones((n, s), other)
                check_array(trial.call(*arrays), (3, n), dtype, what)


def _resolve_untouched(trial: Trial) -> None:
    radiance, weights = _samples_of(trial)
    weights[:5] = 0
    check_untouched(trial, radiance, weights)


def _resolve_refuses(trial: Trial) -> None:
    radiance, weights = np.ones((3, 2, 5), np.float32), np.ones((2, 5), np.float32)
    shape: tuple[int, ...]
    for shape in ((4, 2, 5), (2, 5), (3, 2, 5, 1)):
        wrong = np.ones(shape, np.float32)
        check_refused(trial, wrong, weights, named=f"shape of radiance {shape}")
    for shape in ((5, 2), (2, 4), (10,), (1, 5), (3, 2, 5)):
        wrong = np.ones(shape, np.float32)
        check_refused(trial, radiance, wrong, named=f"shape of weights {shape}")


def _check_mean(trial: Trial, radiance: Array, weights: Array, hint: str) -> None:
    check_close(
        finite_floats(trial.call(radiance, weights), (3, 30)),
        _mean(radiance, weights),
        32 * EPS,
        "a weighted mean of",
        at(weights=weights.T),
        hint,
    )


def _resolve_mean(trial: Trial) -> None:
    for dtype in DTYPES:
        hint = "Samples count by their weights, and equal samples give their own colour."
        _check_mean(trial, *_samples_of(trial, dtype), hint)


def _resolve_scale(trial: Trial) -> None:
    radiance, weights = _samples_of(trial)
    weights *= np.float32(10) ** trial.rng.integers(-20, 6, (30, 1)).astype(np.float32)
    hint = "Weights that are all a hundred times larger or smaller mean the same."
    _check_mean(trial, radiance, weights, hint)


def _resolve_zero(trial: Trial) -> None:
    for dtype in DTYPES:
        radiance, weights = _samples_of(trial, dtype)
        expected = _mean(radiance, weights)
        none = trial.rng.permutation(30)[:6]
        weights[none] = 0
        weights[none[0]] = (1, -1, 2, -2, 0.5, -0.5, 0, 0)
        expected[:, none] = radiance[:, none].mean(axis=2, dtype=float)
        check_close(
            finite_floats(trial.call(radiance, weights), (3, 30)),
            expected,
            32 * EPS,
            "a mean of",
            at(weights=weights.T),
            "Where the weights of a pixel sum to zero, and only there, all samples count alike.",
        )


def _resolve_no_samples(trial: Trial) -> None:
    for dtype in DTYPES:
        value = trial.call(np.zeros((3, 4, 0), dtype), np.zeros((4, 0), dtype))
        found = check_array(value, (3, 4), dtype, "the colour of pixels without samples")
        check_close(found, np.zeros((3, 4)), 0, "without samples,")


# ---------------------------------------------------------------- known mistakes


def _same(found: Any, expected: Array) -> bool:
    return np.shape(found) == expected.shape and bool(
        np.allclose(found, expected, rtol=1e-4, atol=1e-5)
    )


def _regular_lies(axis: Callable[[int], Array]) -> Callable[[Trial], bool]:
    """Whether the grid's coordinates along each axis are those, in either order."""

    def matches(trial: Trial) -> bool:
        k = int(trial.rng.integers(3, 7))
        points = np.asarray(trial.call(k, 2))
        grid = np.stack(np.meshgrid(axis(k), axis(k))).reshape(2, 1, -1)
        both = np.broadcast_to(grid, (2, 2, k * k))
        return _same(points, both) or _same(points, both[::-1])

    return matches


def _y_fastest(trial: Trial) -> bool:
    k = int(trial.rng.integers(3, 7))
    points = np.asarray(trial.call(*_pattern_arguments(trial, k, 50)), float)
    turned = points * k - _cells(k)[::-1]
    return bool(np.abs(turned - 0.5).max() <= 0.5 + 1e-5)


def _own_generator(trial: Trial) -> bool:
    seed = int(trial.rng.integers(2**62))
    first, second = (trial.call(2, 10, np.random.default_rng(seed)) for _ in range(2))
    return np.shape(first) == np.shape(second) and not np.array_equal(first, second)


def _fractions(trial: Trial) -> Array:
    """Random points in their cells' coordinates, in the order they came; plain ones as they are."""
    k = 3
    points = np.asarray(trial.call(k, 200, trial.generator()), float)
    return points * k - _cells(k) if trial.function == "jittered" else points


def _same_axes(trial: Trial) -> bool:
    x, y = _fractions(trial)
    return bool(np.abs(x - y).max() < 1e-4 and np.std(x) > 0.1)


def _same_pixels(trial: Trial) -> bool:
    points = _fractions(trial)
    return bool(np.abs(points - points[:, :1]).max() < 1e-4 and np.std(points) > 0.1)


def _same_cells(trial: Trial) -> bool:
    points = _fractions(trial)
    return bool(np.abs(points - points[:, :, :1]).max() < 1e-4 and np.std(points) > 0.1)


def _not_random(trial: Trial) -> bool:
    points = _fractions(trial)
    return bool(np.std(points - points.mean(axis=(1, 2), keepdims=True)) < 1e-4)


def _not_stratified(trial: Trial) -> bool:
    k = 4
    points = np.asarray(trial.call(k, 1000, trial.generator()), float)
    check_uniform(points.reshape(2, -1), (16, 16), "")
    check_uniform(points[:, :, 5], (4, 4), "")
    return True


def _fractions_fill(low: float, high: Callable[[int], float]) -> Callable[[Trial], bool]:
    """Whether the jitter, in cells, goes evenly from low to high(k)."""

    def matches(trial: Trial) -> bool:
        k = 4
        points = np.asarray(trial.call(k, 500, trial.generator()), float) * k - _cells(k)
        scaled = (points - low) / (high(k) - low)
        inside = bool(scaled.min() > -1e-4 and scaled.max() < 1 + 1e-4)
        check_uniform(scaled.reshape(2, -1), (16, 1), "")
        return inside

    return matches


def _weighs(formula: Callable[[Array, float], Array]) -> Callable[[Trial], bool]:
    """Whether the weights follow another formula of the offsets and sigma."""

    def matches(trial: Trial) -> bool:
        offsets, sigma = _offsets(trial), _sigma(trial)
        expected = formula(offsets.astype(float), sigma)
        if np.allclose(expected, _gaussian(offsets, sigma)):
            return False
        return _same(trial.call(offsets, sigma), expected)

    return matches


def _r2(offsets: Array) -> Array:
    x, y = offsets - 0.5
    return np.asarray(x**2 + y**2)


def _resolves(formula: Callable[[Array, Array], Array]) -> Callable[[Trial], bool]:
    """Whether pixels with ordinary weights follow another formula of radiance and weights."""

    def matches(trial: Trial) -> bool:
        radiance, weights = _samples_of(trial)
        return _same(trial.call(radiance, weights), formula(radiance, weights))

    return matches


def _zero_gives(wanted: Callable[[Array], Array]) -> Callable[[Trial], bool]:
    """Whether pixels with weights of zero, and only they, hold that."""

    def matches(trial: Trial) -> bool:
        radiance, weights = _samples_of(trial)
        weights[:3] = 0
        found = np.asarray(trial.call(radiance, weights))
        return bool(wanted(found[:, :3]).all()) and _same(
            found[:, 3:], _mean(radiance[:, 3:], weights[3:])
        )

    return matches


def _small_weights_dark(trial: Trial) -> bool:
    radiance, weights = _samples_of(trial)
    expected = _mean(radiance, weights)
    small = np.asarray(trial.call(radiance, weights * np.float32(1e-12)))
    dark = bool((small < expected / 2).all())
    return dark and _same(trial.call(radiance, weights), expected)


def _float64(trial: Trial) -> bool:
    arguments: tuple[Any, ...] = _pattern_arguments(trial, 2, 3)
    if trial.function == "gaussian_weights":
        arguments = (_offsets(trial), 0.25)
    elif trial.function == "resolve":
        arguments = _samples_of(trial)
    value = trial.call(*arguments)
    return isinstance(value, np.ndarray) and value.dtype == np.float64


MISTAKES = (
    Mistake(
        "regular",
        "corners-of-cells",
        "Your points stand at the corners of the cells; they belong in the middle of each.",
        _regular_lies(lambda k: np.arange(k) / k),
    ),
    Mistake(
        "regular",
        "both-edges",
        "Your grid goes from one edge of the pixel to the other, so neighbouring pixels share points; "
        "the outermost points should be half a cell inside.",
        _regular_lies(lambda k: np.linspace(0, 1, k)),
    ),
    Mistake(
        "regular",
        "regular-columns",
        "Your cells come column by column; x should grow first, then y.",
        _y_fastest,
    ),
    *(
        mistake
        for function in ("random", "jittered")
        for mistake in (
            Mistake(
                function,
                f"{function}-own-generator",
                "Two generators with the same seed give you different points: "
                "the numbers come from somewhere other than the generator that is handed in.",
                _own_generator,
            ),
            Mistake(
                function,
                f"{function}-same-axes",
                "You use the same random number for x and for y, so the points lie on a diagonal.",
                _same_axes,
            ),
            Mistake(
                function,
                f"{function}-same-pixels",
                "Every pixel gets the same points, which shows as a repeating pattern; "
                "each needs random numbers of its own.",
                _same_pixels,
            ),
        )
    ),
    Mistake(
        "jittered",
        "jittered-same-cells",
        "All cells of a pixel get the same jitter, so your points are a regular grid that is shifted as a whole.",
        _same_cells,
    ),
    Mistake(
        "jittered",
        "jittered-columns",
        "Your cells come column by column; x should grow first, then y.",
        _y_fastest,
    ),
    Mistake(
        "jittered",
        "jitter-from-centre",
        "Your jitter goes from a cell's centre to one side, so half of the points leave their cells.",
        _fractions_fill(0.5, lambda _: 1.5),
    ),
    Mistake(
        "jittered",
        "jitter-about-corner",
        "Your jitter goes to both sides of a cell's corner, so most points leave their cells.",
        _fractions_fill(-0.5, lambda _: 0.5),
    ),
    Mistake(
        "jittered",
        "jitter-too-wide",
        "Your jitter is as wide as the whole pixel; it should be as wide as one cell.",
        _fractions_fill(0, float),
    ),
    Mistake(
        "jittered",
        "not-jittered",
        "Your points are the same in every cell and every pixel: there is no randomness in them.",
        _not_random,
    ),
    Mistake(
        "jittered",
        "not-stratified",
        "Your points are uniform in the whole pixel, so some cells get several and others none.",
        _not_stratified,
    ),
    Mistake(
        "gaussian_weights",
        "sigma-as-variance",
        "You use sigma where its square belongs: sigma is the standard deviation, not the variance.",
        _weighs(lambda p, sigma: np.exp(-_r2(p) / (2 * sigma))),
    ),
    Mistake(
        "gaussian_weights",
        "from-corner",
        "You measure the distance from the pixel's corner; the weight should be largest in its middle.",
        _weighs(lambda p, sigma: np.exp(-(p**2).sum(axis=0) / (2 * sigma**2))),
    ),
    Mistake(
        "gaussian_weights",
        "half-missing",
        "Your Gaussian is too narrow by the square root of two: the exponent lacks its factor of one half.",
        _weighs(lambda p, sigma: np.exp(-_r2(p) / sigma**2)),
    ),
    Mistake(
        "gaussian_weights",
        "distance-not-squared",
        "The distance in your exponent is not squared, which gives a peak with a kink, not a bell.",
        _weighs(lambda p, sigma: np.exp(-np.sqrt(_r2(p)) / (2 * sigma**2))),
    ),
    Mistake(
        "gaussian_weights",
        "density",
        "You scale the weights to a probability density; here the pixel's middle has weight 1.",
        _weighs(lambda p, sigma: np.exp(-_r2(p) / (2 * sigma**2)) / (2 * np.pi * sigma**2)),
    ),
    Mistake(
        "gaussian_weights",
        "normalised-already",
        "You make each pixel's weights sum to 1; that is left to resolve, and here the middle has weight 1.",
        _weighs(
            lambda p, sigma: _gaussian(p, sigma) / _gaussian(p, sigma).sum(axis=1, keepdims=True)
        ),
    ),
    Mistake(
        "gaussian_weights",
        "sigma-ignored",
        "You use the default sigma whatever is asked for.",
        _weighs(lambda p, _: _gaussian(p, 1 / 6)),
    ),
    Mistake(
        "resolve",
        "sum-not-mean",
        "You sum the weighted samples but never divide, so pixels brighten with the number of samples.",
        _resolves(lambda radiance, weights: (radiance * weights).sum(axis=2)),
    ),
    Mistake(
        "resolve",
        "divided-by-count",
        "You divide by the number of samples; it should be by the sum of their weights.",
        _resolves(lambda radiance, weights: (radiance * weights).mean(axis=2)),
    ),
    Mistake(
        "resolve",
        "weights-ignored",
        "All your samples count alike: the weights are not used.",
        _resolves(lambda radiance, _: radiance.mean(axis=2)),
    ),
    Mistake(
        "resolve",
        "divided-by-all-weights",
        "You divide by the sum of all weights of the picture; each pixel has a sum of its own.",
        _resolves(lambda radiance, weights: (radiance * weights).sum(axis=2) / weights.sum()),
    ),
    Mistake(
        "resolve",
        "small-weights-dark",
        "Pixels whose weights are all small come out too dark: you add something to the weights' sum, "
        "or take a small sum for zero.",
        _small_weights_dark,
    ),
    Mistake(
        "resolve",
        "zero-weights-nan",
        "Where all weights of a pixel are zero you divide zero by zero.",
        _zero_gives(np.isnan),
    ),
    Mistake(
        "resolve",
        "zero-weights-black",
        "Where all weights of a pixel are zero your pixel is black; it should be the plain mean there.",
        _zero_gives(lambda found: found == 0),
    ),
    # Last: whoever makes another mistake as well is told that first.
    *(
        Mistake(
            function,
            f"{function.replace('_', '-')}-float64",
            "Your result is float64; the course's pictures are float32, and so should the result be here.",
            _float64,
        )
        for function in ("regular", "random", "jittered", "gaussian_weights", "resolve")
    ),
)

# ---------------------------------------------------------------- the module's checks


_pattern_contracts = partial(
    contract_checks,
    contract=_pattern_contract,
    untouched=_pattern_untouched,
    refuses=_pattern_refuses,
)

CHECKS = ModuleChecks(
    "supersampling",
    checks=(
        *_pattern_contracts("regular"),
        Check("regular", "centres", "Points are the centres of the cells", _regular_centres),
        Check("regular", "order", "Cells come row by row, x fastest", _regular_order),
        *_pattern_contracts("random"),
        Check("random", "seeded", "Points come from the generator given", _seeded),
        distribution_check("random", "uniform", "Points are uniform in the pixel", _uniform, 1),
        distribution_check("random", "samples", "A pixel's samples are independent", _samples, 4),
        distribution_check("random", "pixels", "Pixels are independent of each other", _pixels, 2),
        *_pattern_contracts("jittered"),
        Check("jittered", "seeded", "Points come from the generator given", _seeded),
        Check("jittered", "cells", "Each cell holds one point", _jittered_cells),
        Check("jittered", "order", "Cells come row by row, x fastest", _jittered_order),
        distribution_check("jittered", "uniform", "Points are uniform in their cells", _uniform, 1),
        distribution_check(
            "jittered", "samples", "The jitter of cells is independent", _samples, 4
        ),
        distribution_check(
            "jittered", "pixels", "Pixels are independent of each other", _pixels, 2
        ),
        *contract_checks(
            "gaussian_weights", _gaussian_contract, _gaussian_untouched, _gaussian_refuses
        ),
        Check("gaussian_weights", "formula", "Weights are the Gaussian", _gaussian_formula),
        Check("gaussian_weights", "default", "Sigma is 1/6 by default", _gaussian_default),
        Check(
            "gaussian_weights",
            "extremes",
            "Weights are right for the smallest and the largest sigma",
            _gaussian_extremes,
            "contract",
            points=0.5,
        ),
        *contract_checks("resolve", _resolve_contract, _resolve_untouched, _resolve_refuses),
        Check("resolve", "mean", "Samples count by their weights", _resolve_mean),
        Check("resolve", "scale", "The weights' scale does not matter", _resolve_scale),
        Check("resolve", "zero-weights", "Weights of zero give the plain mean", _resolve_zero),
        Check("resolve", "no-samples", "No samples give black", _resolve_no_samples),
    ),
    mistakes=MISTAKES,
)
