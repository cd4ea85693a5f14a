"""Laws, in the forms in which they come: values in closed form, bounds, distributions, means, and how errors fall.

Each builder gives a ``Law``. What a law looks at are arguments ``a``, by name and in float64, and the results ``r``
(a tuple if there are several), float64 as well, so that a wrong dtype costs the contract alone. A law fails with the
worst column, and with the smallest input that breaks it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from course.core.types import Words
from course.extras.samplers.sobol import net_indices, owen_scrambled, shuffled, sobol_words
from course.grading.checks.check import Array, Failure, Kind, Role, Trial
from course.grading.checks.declare import Arguments, Case, Function, Law
from course.grading.checks.drawing import Draw
from course.grading.checks.examples import call, example, where
from course.grading.checks.samples import crowded, feature_names, off_mean
from course.grading.checks.statistics import FALSE_FAIL, check_mean, check_uniform

EPSILON = float(np.finfo(np.float32).eps)
"""Of single precision: nothing is asked to be more exact, whatever dtype it has."""

DTYPES = (np.float32, np.float64)

MANY = 20_000
"""Points in a check of a distribution."""

Look = Callable[[Arguments, Any], None]
"""Raises ``Failure`` where the results aren't right for the arguments."""

Compare = Callable[[Arguments, Any], tuple[Any, ...]]
"""Found and expected values, and if rounding has another scale than what is expected, that scale."""


def law(
    name: str,
    title: str,
    look: Look,
    *,
    role: Role = "core",
    kind: Kind = "property",
    case: Case | None = None,
    n: int = 1000,
    scales: Iterable[float] = (1.0,),
    points: float = 1.0,
    dtypes: Iterable[Any] = DTYPES,
    figure: Callable[[Trial, Arguments, Any], None] | None = None,
) -> Law:
    """What holds of each call by itself.

    Parameters
    ----------
    look : at arguments and results
    case : what to call the function with; as it is declared if not given
    n : columns
    scales : factors of all lengths, each tried
    points : weight among the checks of its role
    figure : keeps one for a report, of a trial, its arguments and the results
    """

    def run(function: Function, trial: Trial) -> None:
        for scale in scales:
            for dtype in dtypes:
                a = function.make(Draw(trial.rng, n, dtype, scale), case)
                given = exact(a)
                try:
                    r = function.call(trial, a)
                    if figure:
                        figure(trial, given, r)
                    look(given, r)
                except Failure as failure:
                    example(function, trial, failure, look, case)
                    raise

    return Law(name, title, run, role, kind, points, case=case)


def close(
    name: str,
    title: str,
    compare: Compare,
    hint: str = "",
    *,
    what: str = "",
    within: float = 16,
    floor: float = 0.0,
    **how: Any,
) -> Law:
    """Values are what they should be, to rounding.

    Parameters
    ----------
    compare : gives what came and what should have; the last axis are the columns
    what : the value is called so
    within : units in the last place (float32) of the scale, which is the largest value expected, or what ``compare``
        gives: a number, or one for each value
    floor : absolute tolerance besides
    """

    def look(a: Arguments, r: Any) -> None:
        found, expected, *scale = compare(a, r)
        found, expected = np.broadcast_arrays(
            np.asarray(found, np.float64), np.asarray(expected, np.float64)
        )
        if not found.size:
            return
        finite = np.abs(expected[np.isfinite(expected)])
        size = scale[0] if scale else (finite.max() if finite.size else 0.0)
        with np.errstate(invalid="ignore"):
            off = np.abs(found - expected)
        off = np.where(found == expected, 0.0, np.where(np.isnan(off), np.inf, off))
        excess = off - np.broadcast_to(within * EPSILON * np.asarray(size) + floor, off.shape)
        worst = np.unravel_index(int(np.argmax(excess)), excess.shape)
        if not excess[worst] <= 0:
            told = f"{what} " if what else ""
            raise Failure(
                f"{told}{expected[worst]:.7g}" + _row(worst, found.shape),
                f"{found[worst]:.7g}",
                where(a, worst, found.shape),
                hint,
            )

    return law(name, title, look, **how)


def _row(index: tuple[Any, ...], shape: tuple[int, ...]) -> str:
    """Which coordinate it is, where there are several."""
    return f" in row {int(index[0])}" if len(shape) == 2 and shape[0] > 1 else ""


def holds(
    name: str,
    title: str,
    true: Callable[[Arguments, Any], Any],
    says: str,
    hint: str = "",
    *,
    shows: Callable[[Arguments, Any], Any] | None = None,
    **how: Any,
) -> Law:
    """A sentence that is true of each column.

    Parameters
    ----------
    true : (N,) of bool
    says : the sentence: "t_near <= t_far through the inside"
    shows : (N,) numbers that show it; the results if not given
    """

    def look(a: Arguments, r: Any) -> None:
        right = np.asarray(true(a, r))
        if not right.all():
            column = tuple(int(i) for i in np.argwhere(~right)[0])
            shown = np.asarray(shows(a, r)) if shows else None
            came = f"{shown[column]:.6g}" if shown is not None else result_at(r, column)
            raise Failure(says, came, where(a, column, right.shape), hint)

    return law(name, title, look, **how)


def result_at(r: Any, column: tuple[int, ...]) -> str:
    """The results in a column, to be read."""
    parts = r if isinstance(r, tuple) else (r,)
    at = column[-1] if column else ...
    return ", ".join(shown(np.asarray(part)[..., at]) for part in parts)


def shown(values: Any) -> str:
    """Numbers in brackets, or one without."""
    numbers = np.ravel(values).tolist()
    text = ", ".join(f"{number:.6g}" for number in numbers[:12])
    return f"({text})" if np.ndim(values) else text


def within(
    name: str,
    title: str,
    value: Callable[[Arguments, Any], Any],
    low: float,
    high: float,
    hint: str = "",
    *,
    what: str = "a value",
    slack: float = 1e-6,
    role: Role = "corner",
    **how: Any,
) -> Law:
    """Values lie between two bounds, but for rounding."""
    return holds(
        name,
        title,
        lambda a, r: (value(a, r) >= low - slack) & (value(a, r) <= high + slack),
        f"{what} from {low:g} to {high:g}",
        hint,
        shows=value,
        role=role,
        **how,
    )


def unit_length(
    vectors: Callable[[Arguments, Any], Any] = lambda _, r: r, name: str = "unit_length"
) -> Law:
    """Directions are unit length to 1e-5."""
    return close(
        name,
        "Directions are unit length",
        lambda a, r: (np.linalg.norm(vectors(a, r), axis=0), 1.0),
        "Normalise at the end.",
        what="a length of",
        within=0,
        floor=1e-5,
        role="corner",
    )


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
    points: float = 1.0,
    picture: Callable[[Arguments, Any], Array] | None = None,
) -> Law:
    """Features fill the unit cube evenly: each by itself, and all together, by chi-squared tests.

    Parameters
    ----------
    features : (d, n) numbers from 0 to 1, independent and uniform for a right function
    cells : of all of them together
    draws : calls of each dtype, each with arguments of its own
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
                    check_uniform(found[row : row + 1], (24,), f"{name}, alone", hint)
                check_uniform(found, cells, what if not alone else f"{what}, together", hint)
            except Failure as failure:
                failure.example = crowded(found, what)
                raise

    comparisons = 2 * draws * (alone + 1)
    chance = comparisons * FALSE_FAIL
    alike = _none_alike(features, what, case, n)
    return Law(name, title, run, "core", "distribution", points, chance, case=case, beside=alike)


def _none_alike(
    features: Callable[[Arguments, Any], Array], what: str, case: Case | None, n: int
) -> Law:
    """Hardly any points share a number: what is clipped piles up where it is cut off, in a corner only."""

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, n, np.float32), case)
        r = function.call(trial, a)
        _check_no_atoms(np.asarray(features(exact(a), r)), what, a)
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
    again = np.asarray(_first(function.call(trial, back)))
    first = np.asarray(_first(r))
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
    n: int = MANY,
    points: float = 1.0,
) -> Law:
    """Means of independent values are what they should be: z-tests with known variances.

    Parameters
    ----------
    values : gives what each is called, the values, their mean and their variance
    comparisons : how many there are
    """

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, n, np.float32), case)
        for what, some, mean, variance in values(exact(a), function.call(trial, a)):
            try:
                check_mean(np.asarray(some), mean, variance, what, hint)
            except Failure as failure:
                failure.example = off_mean(np.asarray(some), mean, variance, what)
                raise

    return Law(
        name, title, run, "core", "distribution", points, comparisons * FALSE_FAIL, case=case
    )


COUNTS = (16, 64, 256, 1024)
REPEATS = 32


def evenly(
    value: Callable[[Arguments, Any], Array],
    exact_mean: float,
    *,
    case: Case | None = None,
    least: float = 0.65,
    u_name: str = "u",
) -> Law:
    """Evenly placed numbers give evenly placed points: with Sobol's the error of a mean falls faster than with N^-0.5.

    Parameters
    ----------
    value : (N,) smooth values, whose mean is ``exact_mean``
    least : the order that is asked for
    """

    def run(function: Function, trial: Trial) -> None:
        errors, off = [], []
        for number_of in COUNTS:
            word = function.argument(u_name).sizes[0]
            rows = int(word) if word.isdigit() else 1
            numbers = _sobol(trial.rng, number_of, rows)
            a = function.make(Draw(trial.rng, numbers.shape[1], np.float32), case)
            a[u_name] = numbers if word.isdigit() else numbers[0]
            found = np.asarray(value(exact(a), function.call(trial, a)))
            off.append(found.reshape(REPEATS, number_of).mean(axis=1) - exact_mean)
            errors.append(float(np.sqrt((off[-1] ** 2).mean())))
        _check_centred(off, exact_mean)
        check_order(errors, least)

    return Law(
        "order",
        "Evenly placed numbers give evenly placed points",
        run,
        "corner",
        "order",
        false_fail=1e-7 + SKEWED_BY_CHANCE,
        case=case,
    )


SKEWED, SKEWED_BY_CHANCE = 9.0, 1e-9
"""Standard errors, and how often Student's t of 31 degrees of freedom is beyond them."""

ROUNDED = 4e-6
"""Of single precision, in a mean of numbers around 1."""


def _check_centred(off: list[Array], exact_mean: float) -> None:
    """Means over sets that are scrambled independently, of the largest size, are right on average: a t-test."""
    skews, bounds = np.array([_skew(errors) for errors in off]).T
    if not abs(skews[-1]) <= bounds[-1]:
        first = int((~(np.abs(skews) <= bounds)).argmax())
        failure = Failure(
            f"a mean of {exact_mean:.6g} within {bounds[-1]:.1g}",
            f"{exact_mean + skews[-1]:.6g}",
            f"{REPEATS} sets of {COUNTS[-1]} evenly placed points",
            "The mean is off, whatever the number of points: somewhere there are too many, or none.",
        )
        failure.example = (
            f"{REPEATS} sets of {COUNTS[first]} evenly placed points: a mean of {exact_mean:.4g} expected, "
            f"{exact_mean + skews[first]:.4g} came"
        )
        raise failure


def _skew(errors: Array) -> tuple[float, float]:
    """How far means are off on average, and how far they may be."""
    bound = SKEWED * float(errors.std(ddof=1)) / np.sqrt(errors.size) + ROUNDED
    return float(errors.mean()), bound


def check_order(errors: list[float], least: float, hint: str = "") -> None:
    """Errors at ``COUNTS`` fall with that order at the least.

    Raises
    ------
    Failure
    """
    order = fitted(errors)
    if order >= least:
        return
    if min(errors) > 0.3 * max(errors):
        hint = hint or "The mean itself is off, whatever the number of points: that comes first."
    hint = hint or "Neighbouring u should go to neighbouring points, and only u may decide where."
    pairs = zip(COUNTS, errors, strict=True)
    failure = Failure(
        f"the error of a mean to fall with N^-{least} or faster",
        f"N^-{order:.2f}",
        ", ".join(f"{error:.2g} at N = {number_of}" for number_of, error in pairs),
        hint,
    )
    for k in range(len(errors) - 1):
        goal = errors[k] * (COUNTS[k] / COUNTS[k + 1]) ** least
        if errors[k + 1] > goal:
            failure.example = (
                f"from N = {COUNTS[k]} to {COUNTS[k + 1]} the error goes from {errors[k]:.2g} to "
                f"{errors[k + 1]:.2g}; {goal:.2g} or less was expected"
            )
            break
    raise failure


def fitted(errors: list[float]) -> float:
    """The order with which errors at ``COUNTS`` fall."""
    # Float32 sums end near 1e-7; an error there is no error.
    return float(-np.polyfit(np.log(COUNTS), np.log(np.maximum(errors, 1e-7)), 1)[0])


def _sobol(rng: np.random.Generator, number_of: int, rows: int) -> Array:
    """(rows, REPEATS * number_of): so many numbers after each other, each time scrambled anew."""
    index = shuffled(np.arange(number_of, dtype=np.uint32), 1)[0]
    words: Words = np.concatenate([sobol_words(index), sobol_words(net_indices(index))])[
        :rows, None
    ]
    seeds = rng.integers(1 << 32, size=(rows, REPEATS, 1), dtype=np.uint32)
    found: Array = (owen_scrambled(words, seeds) >> np.uint32(8)) * np.float32(2.0**-24)
    return found.reshape(rows, -1)


def smooth(limit: float, *, case: Case | None = None, u_name: str = "u") -> Law:
    """A small step of u is a small step of the point: angles in degrees make a step 57 times as long.

    Parameters
    ----------
    limit : of the way that a point goes, over the step of u that makes it, for most u
    """
    step = 2.0**-12

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, 600, np.float64), case)
        numbers = a[u_name] * (1 - 2 * step)
        rows = range(numbers.shape[0] if numbers.ndim == 2 else 1)
        a[u_name] = numbers
        first = np.asarray(_first(function.call(trial, a)))
        for row in rows:
            moved = numbers.copy()
            (moved[row] if numbers.ndim == 2 else moved)[...] += step
            a[u_name] = moved
            way = np.abs(np.asarray(_first(function.call(trial, a))) - first)
            far = (np.linalg.norm(way, axis=0) if way.ndim == 2 else way) / step
            # Where a warp has a seam some points jump; half of them never do.
            typical = float(np.median(far))
            if not typical <= limit:
                k = int(np.argsort(far)[far.size // 2])
                raise Failure(
                    f"a small step of {u_name} to move a point at most {limit:g} times as far",
                    f"{typical:.4g} times as far for most points",
                    f"{where(a, (k,), (numbers.shape[-1],))}, and {step:.2g} less in row {row}",
                    "Are all angles in radians, and used once?",
                )

    return Law(
        "smooth",
        "A small step of u is a small step of the point",
        run,
        "corner",
        case=case,
    )


def _first(r: Any) -> Any:
    return r[0] if isinstance(r, tuple) else r


def from_generator(argument: str = "rng") -> Law:
    """All that is random comes from the generator that is handed in."""

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, 20, np.float32))
        seed = int(trial.rng.integers(2**62))
        first, again, other = (
            function.call(trial, Arguments(a | {argument: np.random.default_rng(s)}))
            for s in (seed, seed, seed + 1)
        )
        if not _equal(first, again):
            raise Failure(
                "the same result from generators with the same seed",
                "another result",
                call(function.name, a),
                "All random numbers come from the generator that is handed in.",
            )
        if _equal(first, other):
            raise Failure(
                "another result from a generator with another seed",
                "the same result",
                call(function.name, a),
                "The generator that is handed in has to be used.",
            )

    return Law("from_rng", "All random numbers come from the generator", run, "corner")


def _equal(one: Any, other: Any) -> bool:
    """Whether two results are the same, bit for bit."""
    several = isinstance(one, tuple)
    pairs = zip(one, other, strict=True) if several else ((one, other),)
    return all(np.array_equal(a, b) for a, b in pairs)


def exact(a: Arguments) -> Arguments:
    """Copies of the arguments, floating ones in float64."""
    return Arguments(
        {
            name: value.astype(np.float64 if value.dtype.kind == "f" else value.dtype)
            if isinstance(value, np.ndarray)
            else value
            for name, value in a.items()
        }
    )
