"""Laws about distributions: samples are uniform, and their means are right; a right function fails each by 1e-7.

Students' points may be stratified, since the numbers that they warp may be Sobol's. All tests here are for independent
numbers, so the checks draw theirs from ``Trial.rng``. A failure shows the smallest sample that is wrong: the fewest
points, and where too many or too few lie.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from itertools import combinations, product
from math import sqrt
from typing import Any

import numpy as np
from scipy.special import chdtri, ndtri

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import DTYPES, WHOLE, Arguments, Case, Function, Law
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import where
from course.school.grading.checks.laws import exact, first_result, result_at, shown

FALSE_FAIL = 1e-7
"""Of each comparison: a hundred in an assignment stay under 1e-5."""

SIGMAS = -float(ndtri(FALSE_FAIL / 2))
"""Standard errors that a mean or a share must be off to fail."""

MANY = 20_000
"""Points in a check of a distribution."""


def uniform(
    name: str,
    title: str,
    features: Callable[[Arguments, Any], Array],
    cells: tuple[int, ...],
    hint: str = "",
    *,
    what: str = "places",
    case: Case | None = None,
    draws: int = 1,
    n: int = MANY,
    whole: bool = False,
    picture: Callable[[Arguments, Any], Array] | None = None,
) -> Law:
    """Features fill the unit cube evenly: each by itself, and all together, by chi-squared tests.

    Parameters
    ----------
    features : (d, n) numbers from 0 to 1, independent and uniform for a right function
    cells : of all of them together
    draws : calls of each dtype, each with arguments of its own
    whole : whether it says all of the function's values
    picture : (2, n) points that show it; the features if not given
    """
    alone = len(cells) if len(cells) > 1 else 0

    def run(function: Function, trial: Trial) -> None:
        for dtype in DTYPES * draws:
            a = function.make(Draw(trial.rng, n, dtype), case)
            r = function.call(trial, a)
            if "u" in a:
                _check_told(function, trial, a, r)
            given = exact(a)
            found = np.asarray(features(given, r))
            drawn = picture(given, r) if picture else found[:2]
            if len(drawn) == 2:
                trial.show("points", what, yours=drawn[:, :2000])
            outside = np.maximum(-found, found - 1).max(axis=0)
            if not outside.max() <= 1e-4:
                k = int(outside.argmax())
                raise Failure(
                    f"{what} from 0 to 1", shown(found[:, k]), where(given, (k,), (n,)), hint
                )
            try:
                for row, name in zip(range(alone), feature_names(what, len(found)), strict=False):
                    check_uniform(found[row : row + 1], (24,), f"{name}, by itself", hint)
                check_uniform(found, cells, what if not alone else f"{what}, together", hint)
            except Failure as failure:
                failure.example = crowded(found, what)
                raise

    comparisons = 2 * draws * (alone + 1)
    chance = comparisons * FALSE_FAIL
    alike = _none_alike(features, what, case, n)
    points = WHOLE if whole else 1.0
    return Law(name, title, run, "core", "distribution", points, chance, case=case, beside=alike)


def _none_alike(
    features: Callable[[Arguments, Any], Array], what: str, case: Case | None, n: int
) -> Law:
    """Hardly any points share a number: what is clipped piles up where it is cut off, in a corner only."""

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, n, np.float32), case)
        r = function.call(trial, a)
        _check_no_atoms(np.round(features(exact(a), r), 5), what, a)  # but for rounding
        if case is None and isinstance(r, np.ndarray) and r.ndim == 2:
            _check_no_atoms(r, "coordinates of the points", a)

    return Law("alike", "Hardly any points share a number", run, "corner", "property", case=case)


def _check_told(function: Function, trial: Trial, a: Arguments, r: Any) -> None:
    """The numbers u decide, each column's by themselves: the columns in reverse give the same, in reverse."""
    back = Arguments(a)
    sizes = function.results[0].sizes
    turned = function.columns and "N" in sizes
    for argument in function.arguments if turned else ():
        if argument.axis is not None:
            back[argument.name] = np.ascontiguousarray(np.flip(a[argument.name], argument.axis))
    again = np.asarray(first_result(function.call(trial, back)))
    first = np.asarray(first_result(r))
    again = np.flip(again, sizes.index("N")) if turned else again
    slack = 1e-5 * float(np.abs(first).max(initial=0))
    same = np.isclose(first, again, rtol=1e-4, atol=slack, equal_nan=True)
    if not same.all():
        column = tuple(int(i) for i in np.argwhere(~same)[0])
        raise Failure(
            f"{result_at(first, column)} again for the same u, wherever it stands in the batch",
            result_at(again, column),
            where(a, column, first.shape),
            hint="All random numbers are given, and each column has its own: nothing else is to be drawn.",
            slip="not-by-its-column",
        )


ATOM = 0.003
"""Share of points that may be one: of 64,000 of single precision hardly three are."""


def _check_no_atoms(found: Array, what: str, a: Arguments) -> None:
    """Hardly any points share a number: what is clipped piles up where it is cut off."""
    for name, row in zip(feature_names(what, len(found)), found, strict=True):
        values, counts = np.unique(row, return_counts=True)
        most = int(counts.argmax())
        if counts[most] > max(ATOM * row.size, 3):
            raise Failure(
                f"{what}: hardly any two alike",
                f"{name} is {values[most]:.4g} for {counts[most]} of {row.size} points",
                " and ".join(
                    where(a, (k,), row.shape) for k in np.flatnonzero(row == values[most])[:2]
                ),
                "Nothing is to be cut off, nor rounded to a grid.",
            )


def means(
    name: str,
    title: str,
    values: Callable[[Arguments, Any], Iterable[tuple[str, Array, float, float]]],
    hint: str = "",
    *,
    comparisons: int,
    case: Case | None = None,
) -> Law:
    """Means of independent values are what they should be: z-tests with known variances.

    Parameters
    ----------
    values : gives what each is called, the values, their mean and their variance
    comparisons : how many there are
    """

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, MANY, np.float32), case)
        for what, some, mean, variance in values(exact(a), function.call(trial, a)):
            try:
                check_mean(np.asarray(some), mean, variance, what, hint)
            except Failure as failure:
                failure.example = off_mean(np.asarray(some), mean, variance, what)
                raise

    chance = comparisons * FALSE_FAIL
    return Law(name, title, run, "core", "distribution", 1.0, chance, case=case)


# ---------------------------------------------------------------- tests


def check_uniform(values: Array, cells: tuple[int, ...], what: str, hint: str = "") -> None:
    """(d, N) values fill the unit cube evenly: Pearson's chi-squared test over a grid of cells. Raises Failure."""
    counts = counted(values, cells)
    expected = values.shape[1] / counts.size
    chi_squared(counts.ravel(), np.full(counts.size, expected), what, hint)


def counted(values: Array, cells: tuple[int, ...]) -> Array:
    """How many of (d, N) values in the unit cube lie in each cell of a grid."""
    index = np.clip((values.T * cells).astype(np.int64), 0, np.array(cells) - 1)
    return np.bincount(
        np.ravel_multi_index(tuple(index.T), cells), minlength=int(np.prod(cells))
    ).reshape(cells)


def chi_squared(counts: Array, expected: Array, what: str, hint: str = "") -> None:
    """Counts are as probable as that. Raises Failure."""
    statistic = float(((counts - expected) ** 2 / expected).sum())
    limit = float(chdtri(counts.size - 1, FALSE_FAIL))
    if not statistic < limit:
        worst = int(np.argmax(np.abs(counts - expected) / np.sqrt(expected)))
        raise Failure(
            f"{what}: each of {counts.size} cells as often as it should be, so chi-squared under {limit:.0f}",
            f"chi-squared {statistic:.0f}",
            f"cell {worst} came {counts.flat[worst]:.0f} times, {expected.flat[worst]:.0f} were to be expected",
            hint,
        )


def check_mean(values: Array, mean: float, variance: float, what: str, hint: str = "") -> None:
    """Independent values have that mean: a two-sided z-test with their known variance. Raises Failure."""
    found = float(values.astype(np.float64).mean())
    bound = SIGMAS * sqrt(variance / values.size)
    if not abs(found - mean) <= bound:
        raise Failure(f"{what}: {mean:.6g} within {bound:.2g}", f"{found:.6g}", "", hint)


# ---------------------------------------------------------------- the smallest sample


def feature_names(what: str, rows: int) -> list[str]:
    """Names of features, from what they are called together: "r^2 and turn" are two."""
    parts = re.split(r",? and |, ", what)
    alone = [what] if rows == 1 else [f"number {row + 1} of {what}" for row in range(rows)]
    return parts if len(parts) == rows else alone


def crowded(found: Array, what: str) -> str:
    """Of (d, N) features that should fill the unit cube evenly, the fewest that don't; empty if no box shows it.

    Boxes are halves to sixteenths of one feature, and halves and quarters of two.
    """
    best: tuple[int, int, float, str] | None = None
    for share, region, inside in _boxes(np.clip(found, 0, np.nextafter(1.0, 0)), what):
        counts, points = np.cumsum(inside), np.arange(1, inside.size + 1)
        spread = np.sqrt(points * share * (1 - share))
        # A normal distribution stands for the binomial one: with five expected it is near enough for an example.
        off = (np.abs(counts - points * share) > SIGMAS * spread) & (points * share >= 5)
        if off.any():
            fewest = int(points[off.argmax()])
            if best is None or fewest < best[0]:
                best = fewest, int(counts[off.argmax()]), fewest * share, region
    if best is None:
        return ""
    fewest, count, expected, region = best
    return f"the first {fewest} points: {expected:.0f} expected with {region}, {count} came"


def _boxes(found: Array, what: str) -> Iterator[tuple[float, str, Array]]:
    """Shares of the unit cube, what they are called, and which points lie there."""
    names = feature_names(what, len(found))
    for row, name in zip(found, names, strict=True):
        for parts in (2, 4, 8, 16):
            for part in range(parts):
                yield 1 / parts, _between(name, part, parts), (row * parts).astype(int) == part
    for (one, other), parts in product(combinations(range(len(found)), 2), (2, 4)):
        places = (found[[one, other]] * parts).astype(int)
        for first, second in product(range(parts), repeat=2):
            told = (_between(names[one], first, parts), _between(names[other], second, parts))
            inside = (places == [[first], [second]]).all(axis=0)
            yield 1 / parts**2, " and ".join(told), inside


def _between(name: str, part: int, parts: int) -> str:
    return f"{name} from {part / parts:g} to {(part + 1) / parts:g}"


def off_mean(values: Array, mean: float, variance: float, what: str) -> str:
    """The fewest values, 30 at least, whose mean is off; empty if none are."""
    points = np.arange(1, values.size + 1)
    means = np.cumsum(values, dtype=np.float64) / points
    off = (np.abs(means - mean) > SIGMAS * np.sqrt(variance / points)) & (points >= 30)
    if not off.any():
        return ""
    fewest = int(off.argmax())
    return f"the first {fewest + 1} points: {what} {mean:.4g} expected, {means[fewest]:.4g} came"
