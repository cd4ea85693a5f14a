"""Laws that hold of each call by itself: values in closed form, sentences, bounds, and the generator that is used.

Each builder gives a ``Law``; laws about many samples stand in ``distributions.py`` and ``evenness.py``. A law looks at
arguments ``a``, by name, and results ``r``, a tuple if there are several. Both are float64, so that a wrong dtype costs
the contract alone. A law fails with the worst column, and with the smallest input that breaks it.
"""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Kind, Role, Trial
from course.school.grading.checks.declare import DTYPES, WHOLE, Arguments, Case, Function, Law
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import call, example, number, told_apart, where

EPSILON = float(np.finfo(np.float32).eps)
"""Of single precision: nothing is asked to be more exact, whatever dtype it has."""

Look = Callable[[Arguments, Any], None]
"""Raises ``Failure`` where the results aren't right for the arguments."""

Compare = Callable[[Arguments, Any], tuple[Any, ...]]
"""Found and expected values, and if rounding has another scale than what is expected, that scale."""


def law(
    name: str,
    title: str,
    look: Look,
    *,
    role: Role = "corner",
    kind: Kind = "property",
    case: Case | None = None,
    n: int = 1000,
    scales: Iterable[float] = (1.0,),
    whole: bool = False,
    points: float = 1.0,
    dtypes: Iterable[Any] = DTYPES,
    figure: Callable[[Trial, Arguments, Any], None] | None = None,
    ends: bool = False,
) -> Law:
    """What holds of each call by itself.

    Parameters
    ----------
    look : at arguments and results
    case : what to call the function with; as it is declared if not given
    n : columns
    scales : factors of all lengths, each tried
    whole : whether it says all of the function's values, which makes it the core's largest
    points : weight among the checks of its role
    figure : keeps one for a report, of a trial, its arguments and the results
    ends : whether it is looked at in the ends of what is legal, too, which random numbers never meet. Lengths and
        bounds are; of values, right ways of writing a formula may differ there by their rounding
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

    role, points = ("core", WHOLE) if whole else (role, points)
    at_ends = look if ends else None
    tried = tuple(dtypes)
    return Law(name, title, run, role, kind, points, case=case, dtypes=tried, at_ends=at_ends)


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
            asked, came = told_apart(expected[worst], found[worst])
            raise Failure(
                f"{told}{asked}" + _row(worst, found.shape),
                came,
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
            came = number(shown[column]) if shown is not None else result_at(r, column)
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
    text = ", ".join(map(number, numbers[:12]))
    return f"({text})" if np.ndim(values) else text


def over_threshold(
    name: str,
    title: str,
    value: Callable[[Arguments], Array],
    hint: str,
    *,
    what: str,
    **how: Any,
) -> Law:
    """Columns are chosen whose value (N,) is over ``a.threshold``; ``what`` says what that is of what."""

    def look(a: Arguments, r: Array) -> None:
        values = value(a)
        expected = values > a.threshold
        wrong = np.flatnonzero(r != expected)
        if wrong.size:
            k = int(wrong[0])
            raise Failure(
                f"{bool(expected[k])} where {what} is {values[k]:.6g} and the threshold {a.threshold:.6g}",
                f"{bool(r[k])}",
                f"{where(a, (k,), r.shape)}; {wrong.size} of {r.size} are wrong",
                hint,
            )

    return law(name, title, look, **how)


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
        ends="case" not in how,
        **how,
    )


def unit_length(vectors: Callable[[Arguments, Any], Any] = lambda _, r: r) -> Law:
    """Directions are unit length to 1e-5."""
    return close(
        "unit_length",
        "Directions are unit length",
        lambda a, r: (np.linalg.norm(vectors(a, r), axis=0), 1.0),
        "Normalise at the end. The axes of a basis are unit length, too, and at right angles.",
        what="a length of",
        within=0,
        floor=1e-5,
        ends=True,
    )


def first_result(r: Any) -> Any:
    """The first of the results, or the only one."""
    return r[0] if isinstance(r, tuple) else r


def from_generator() -> Law:
    """All that is random comes from the generator that is handed in."""

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, 20, np.float32))
        seed = int(trial.rng.integers(2**62))
        rng = np.random.default_rng(seed)
        before, given = rng.bit_generator.state, Arguments(a | {"rng": rng})
        value, after, _ = trial.caller.call_and_look(trial.function, *given.values())
        first = function.seen(value, given)
        again, other = (
            function.call(trial, Arguments(a | {"rng": np.random.default_rng(s)}))
            for s in (seed, seed + 1)
        )
        (moved,) = (each for each in after if isinstance(each, np.random.Generator))
        if moved.bit_generator.state == before:
            raise Failure(
                "the generator to have moved on",
                "it stands where it stood, and the next call gives the same numbers",
                call(function.name, a),
                "Draw from the generator itself, not from a copy of it.",
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

    return Law("from_rng", "All random numbers come from the generator", run)


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
