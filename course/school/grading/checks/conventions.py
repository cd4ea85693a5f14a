"""The checks that follow from a declaration: what the course's conventions ask of every function."""

from collections.abc import Callable, Iterator
from copy import deepcopy
from itertools import product
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import COLUMNS, DTYPES, Argument, Arguments, Function, Law
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import call, told_apart, where
from course.school.grading.checks.laws import EPSILON, exact
from course.school.grading.checks.refusals import refuses
from course.school.grading.looked import EARLIER_RESULT, RANDOM_STATE

SIZES = (2, 1, 0, 17)
"""Columns."""


DRAWS = 6
"""Times that each law's case is drawn."""


def conventions(function: Function) -> tuple[Law, ...]:
    """The function's conventions, as laws."""
    found = [
        ("contract", "Shapes and dtypes are as agreed, and all numbers finite", _contract),
        (
            "untouched",
            "Arguments, earlier results and the global random state are left alone",
            _untouched,
        ),
        ("refuses", "Wrong arguments raise ValueError", refuses),
    ]
    if any(argument.sizes for argument in function.arguments):
        title = "Neither memory layout nor earlier calls change a result"
        found.append(("layouts", title, _layouts))
    if function.columns and any(argument.axis is not None for argument in function.arguments):
        found.append(("columns", "Each column depends on its own arguments alone", _columns))
    laws = tuple(Law(name, title, run, "convention", "contract") for name, title, run in found)
    draw = Draw(np.random.default_rng(0), 1)
    if any(law.at_ends for law in function.laws) and function.extremes(draw):
        title = (
            "Bounds and lengths hold at the ends of what is legal, which random numbers never meet"
        )
        laws += (Law("at_the_ends", title, _at_the_ends),)
    return laws


# ---------------------------------------------------------------- contract


def _contract(function: Function, trial: Trial) -> None:
    for a, of in _legal(function, trial):
        try:
            function.seen(trial.call(*a.values()), a, function.promoted(a) or np.float32)
        except Failure as failure:
            failure.where = failure.where or of
            failure.example = call(function.name, a) if "columns" not in of else ""
            raise


def _legal(function: Function, trial: Trial) -> Iterator[tuple[Arguments, str]]:
    """Arguments of every size, every mixture of dtypes, and at the ends of what is legal; and what they are."""
    for dtype in DTYPES:
        for n in SIZES:
            yield function.make(Draw(trial.rng, n, dtype)), f"N = {n}, {np.dtype(dtype)}"
        for scale in function.scales:
            a = function.make(Draw(trial.rng, 5, dtype, scale))
            yield a, f"lengths around {scale:g}, {np.dtype(dtype)}"
        for a in function.ends(Draw(trial.rng, 1, dtype)):
            yield a, f"columns at the ends of what is legal, {np.dtype(dtype)}"
            yield from _mixed(function, a)
    # What has nothing to do, as for a roughness of 0, is often handed back as it came.
    for law in function.laws:
        # A case may choose at random among what has nothing to do and what has.
        for dtype, _ in product(law.dtypes, range(DRAWS)) if law.case else ():
            a = function.make(Draw(trial.rng, 5, dtype), law.case)
            yield a, f"5 columns, {np.dtype(dtype)}"
            if dtype == np.float32:
                yield from _mixed(function, a)
    for n in (5, 0):
        yield from _mixed(function, function.make(Draw(trial.rng, n, np.float32)))
    singles = [argument for argument in function.arguments if argument.single]
    for dtype in DTYPES if singles else ():
        for kind in (np.float32, np.float64):
            a = function.make(Draw(trial.rng, 5, dtype))
            for argument in singles:
                a[argument.name] = kind(argument.one(a[argument.name]))
            yield a, f"one {singles[0].name} for all, of {np.dtype(kind)}"
    for kind in (np.float32, np.float64):
        a = function.make(Draw(trial.rng, 5, np.float32))
        for argument in function.arguments:
            if not argument.batch and isinstance(a[argument.name], float | np.ndarray):
                a[argument.name] = kind(a[argument.name])
        yield a, f"single points and numbers of {np.dtype(kind)}"


def _mixed(function: Function, a: Arguments) -> Iterator[tuple[Arguments, str]]:
    """The same arguments with one batch of another dtype than the rest, each in turn; none if there is only one."""
    batches = [argument.name for argument in function.arguments if argument.batch]
    floating = [name for name in batches if isinstance(a[name], np.ndarray)]
    floating = [name for name in floating if a[name].dtype.kind == "f"]
    for other, (few, rest) in product(floating, (DTYPES, DTYPES[::-1])) if floating[1:] else ():
        dtypes = {name: few if name == other else rest for name in floating}
        mixed = Arguments(a | {name: _cast(name, a[name], dtype) for name, dtype in dtypes.items()})
        yield mixed, "batches of float32 and float64"


def _cast(name: str, value: Array, dtype: Any) -> Array:
    """The values in another dtype; u stays below 1, to which the largest number below it would be rounded."""
    found = value.astype(dtype)
    return np.minimum(found, np.nextafter(found.dtype.type(1), 0)) if name == "u" else found


# ---------------------------------------------------------------- at_the_ends


def _at_the_ends(function: Function, trial: Trial) -> None:
    for dtype in DTYPES:
        for a in function.extremes(Draw(trial.rng, 1, dtype)):
            given, r = exact(a), function.call(trial, a)
            for law in function.laws:
                if law.at_ends and dtype in law.dtypes:
                    law.at_ends(given, r)


# ---------------------------------------------------------------- untouched


def _untouched(function: Function, trial: Trial) -> None:
    for a in _untouched_by(function, trial):
        before = deepcopy([_arrays(value) for value in a.values()])
        _, after, changed = trial.caller.call_and_look(trial.function, *a.values())
        for name, old, new in zip(a, before, after, strict=True):
            pairs = zip(old, _arrays(new), strict=True)
            if not all(np.array_equal(one, other, equal_nan=True) for one, other in pairs):
                raise Failure(
                    f"{name} to be left as it was",
                    "it has been written to",
                    call(function.name, a),
                    "Work on a copy.",
                    slip="writes-to-arguments",
                )
        if EARLIER_RESULT in changed:
            raise Failure(
                "what an earlier call has returned to be left as it was",
                "this call has written to it",
                call(function.name, a),
                "Make a new array in every call: who holds the earlier one finds other numbers in it.",
                slip="overwrites-results",
            )
        if RANDOM_STATE in changed:
            raise Failure(
                "NumPy's global random state to be left alone",
                "the function seeds it or draws from it",
                call(function.name, a),
                "The random numbers are given: u, or rng.",
                slip="global-random-state",
            )


def _untouched_by(function: Function, trial: Trial) -> Iterator[Arguments]:
    """Ordinary arguments, then those at the ends and of each law's case, where something may be mended in place."""
    # Twice as many columns: memory that is used again is mostly that of as large a result.
    for n in (3, 50, 50):
        yield function.make(Draw(trial.rng, n, np.float32))
    # What converts its arguments to double precision has a copy of others, but not of these.
    yield function.make(Draw(trial.rng, 20, np.float64))
    yield from function.ends(Draw(trial.rng, 1, np.float32))
    for law in function.laws:
        if law.case and np.float32 in law.dtypes:
            yield function.make(Draw(trial.rng, 20, np.float32), law.case)


def _arrays(value: Any) -> list[Array]:
    """Those of an argument: itself, or what it holds."""
    parts = value if isinstance(value, tuple | list) else (value,)
    return [part for part in parts if isinstance(part, np.ndarray)]


# ---------------------------------------------------------------- layouts and columns


def scattered(array: Array) -> Array:
    """The same values, in memory that is contiguous along no axis."""
    wide = np.zeros(tuple(3 * size for size in array.shape), array.dtype)
    view: Array = wide[tuple(slice(1, None, 3) for _ in array.shape)]
    view[...] = array
    return view


def frozen(array: Array) -> Array:
    """A copy that can't be written to."""
    copy: Array = array.copy()
    copy.flags.writeable = False
    return copy


AGAIN = "the same again"

LAYOUTS: dict[str, Callable[[Array], Array]] = {
    AGAIN: lambda array: array,
    "Fortran's order": np.asfortranarray,
    "every third number of a larger array": scattered,
    "arrays that can't be written to": frozen,
}


def _layouts(function: Function, trial: Trial) -> None:
    made = function.make(Draw(trial.rng, 20, np.float32))
    expected = _parts(function.call(trial, made))
    for name, layout in LAYOUTS.items():
        a = Arguments({key: _laid(value, layout) for key, value in made.items()})
        slip = "remembers-calls" if name == AGAIN else ""
        _same(_parts(function.call(trial, a)), expected, made, f"the result for {name}", slip)
    singles = {argument.name: argument for argument in function.arguments if argument.single}
    if singles:
        one = {name: each.one(made[name]) for name, each in singles.items()}
        tiled = Arguments(
            made | {name: _tiled(one[name], made[name], each) for name, each in singles.items()}
        )
        expected = _parts(function.call(trial, tiled))
        for name in singles:
            a = Arguments(tiled | {name: one[name]})
            what = f"the result for one {name} for all columns"
            _same(_parts(function.call(trial, a)), expected, a, what)


def _tiled(one: Any, batch: Array, argument: Argument) -> Array:
    """One value in each column of a batch."""
    column = np.expand_dims(np.asarray(one, batch.dtype), argument.axis or 0)
    return np.ascontiguousarray(np.broadcast_to(column, batch.shape))


def _laid(value: Any, layout: Callable[[Array], Array]) -> Any:
    """A value, its arrays in another layout."""
    if isinstance(value, tuple):
        return tuple(_laid(part, layout) for part in value)
    return layout(value) if isinstance(value, np.ndarray) and value.ndim else value


def _columns(function: Function, trial: Trial) -> None:
    total = min(1000, function.most)
    a = function.make(Draw(trial.rng, total, np.float32))
    every = _parts(function.call(trial, a))
    # Of as many as laws look at. As many as there are rows is a case of its own where something is broadcast.
    for n in (99, 40, 17, 7, 1, 2, 3, 4):
        order, some = trial.rng.permutation(total)[:n], Arguments(a)
        for argument in function.arguments:
            if argument.axis is not None:
                columns = a[argument.name].take(order, argument.axis)
                some[argument.name] = np.ascontiguousarray(columns)
        found, wanted = _parts(function.call(trial, some)), []
        for part, result in zip(every, function.results, strict=True):
            there = COLUMNS in result.sizes
            wanted.append(part.take(order, result.sizes.index(COLUMNS)) if there else part)
        what = (
            f"the same column among {len(order)}, in another order:"
            if n > 1
            else "the same column alone:"
        )
        _same(found, wanted, some, what, "not-by-its-column")


def _same(
    found: list[Array], expected: list[Array], a: Arguments, what: str, slip: str = ""
) -> None:
    for part, other in zip(found, expected, strict=True):
        if part.shape != other.shape:
            raise Failure(f"{what} of shape {other.shape}", f"{part.shape}", slip=slip)
        if part.dtype.kind == "f":
            finite = np.abs(other[np.isfinite(other)])
            slack = 64 * EPSILON * (float(finite.max()) if finite.size else 0.0)
            with np.errstate(invalid="ignore"):
                # Infinite ones may be equal, too.
                off = np.where(part == other, 0.0, np.abs(part - other))
        else:
            slack, off = 0.0, (part != other).astype(float)
        if off.size and not off.max() <= slack:
            worst = np.unravel_index(int(np.argmax(off)), off.shape)
            first, second = told_apart(other[worst], part[worst], 6)
            raise Failure(
                f"{what} {first}",
                second,
                where(a, worst, part.shape),
                "A result hangs on the numbers of its own column, and on nothing else.",
                slip,
            )


def _parts(r: Any) -> list[Array]:
    return list(r) if isinstance(r, tuple) else [r]
