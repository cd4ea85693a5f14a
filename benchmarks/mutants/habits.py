"""Right functions written by other habits: the reference with another precision, layout, order of work or of numbers.

Each habit takes a right function and gives another that is as right. None may lose a point, whatever the seed.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from course.engine.functions.effects import Effects
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Function, declared_function
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.references import SOLUTIONS

Call = Callable[..., Any]
Habit = Callable[[Function, Call], Call]


def _of_results(change: Callable[[Array], Any]) -> Habit:
    """A habit that hands the same numbers back in another way."""

    def habit(_: Function, call: Call) -> Call:
        def function(*arguments: Any) -> Any:
            value = call(*arguments)
            if isinstance(value, tuple):
                return tuple(change(v) if isinstance(v, np.ndarray) else v for v in value)
            return change(value) if isinstance(value, np.ndarray) else value

        return function

    return habit


def _of_arguments(change: Callable[[Any], Any]) -> Habit:
    """A habit that works on arguments in another form, and hands back what the conventions ask for."""

    def habit(declared: Function, call: Call) -> Call:
        def function(*arguments: Any) -> Any:
            # A legal call comes first as it is: whatever it refuses is refused, and it says which dtypes to give.
            plain = call(*_copied(arguments))
            value = call(*(change(a) for a in _copied(arguments)))
            several = isinstance(plain, tuple)
            pairs = zip(value, plain, strict=True) if several else [(value, plain)]
            typed = tuple(
                v.astype(p.dtype) if isinstance(p, np.ndarray) and isinstance(v, np.ndarray) else v
                for v, p in pairs
            )
            return typed if several else typed[0]

        return function if not _draws(declared) else call

    return habit


def _copied(arguments: tuple[Any, ...]) -> list[Any]:
    return [a.copy() if isinstance(a, np.ndarray) else a for a in arguments]


def _draws(declared: Function) -> bool:
    """Whether it is given a generator, which two calls may not share."""
    return any(argument.name == "rng" for argument in declared.arguments)


def _by_columns(declared: Function, call: Call, *, at_once: int) -> Call:
    """So many columns at a time, put together in the end."""
    axes = [argument.axis for argument in declared.arguments]
    words = [result.sizes for result in declared.results]
    if (
        not declared.columns
        or all(axis is None for axis in axes)
        or any("N" not in w for w in words)
    ):
        return call

    def function(*arguments: Any) -> Any:
        whole = call(*arguments)
        batches = [
            (a, axis)
            for a, axis, argument in zip(arguments, axes, declared.arguments, strict=False)
            if axis is not None and np.ndim(a) == len(argument.sizes)
        ]
        count = batches[0][0].shape[batches[0][1]] if batches else 0
        if not 0 < count <= 300:
            return whole
        found = []
        for start in range(0, count, at_once):
            part = [
                a.take(range(start, min(start + at_once, count)), axis)
                if axis is not None and np.ndim(a) == len(argument.sizes)
                else a
                for a, axis, argument in zip(arguments, axes, declared.arguments, strict=False)
            ]
            value = call(*part)
            found.append(value if isinstance(value, tuple) else (value,))
        joined = tuple(
            np.concatenate([piece[k] for piece in found], word.index("N"))
            for k, word in enumerate(words)
        )
        return joined if isinstance(whole, tuple) else joined[0]

    return function


def _turning(change: Callable[[Array], Array]) -> Habit:
    """A habit that uses u in another way, where it is free."""

    def habit(declared: Function, call: Call) -> Call:
        names = [argument.name for argument in declared.arguments]
        if not declared.free or "u" not in names:
            return call
        place = names.index("u")

        def function(*arguments: Any) -> Any:
            u = arguments[place]
            if np.ndim(u) == len(declared.arguments[place].sizes) and u.dtype.kind == "f":
                arguments = (*arguments[:place], change(u), *arguments[place + 1 :])
            return call(*arguments)

        return function

    return habit


def _mirrored(u: Array) -> Array:
    found: Array = np.clip(1 - u, 0, np.nextafter(u.dtype.type(1), u.dtype.type(0)))
    return found


def _own_generator(declared: Function, call: Call) -> Call:
    """Draws from a generator of its own, which the one that is handed in seeds."""
    if not _draws(declared):
        return call

    def function(*arguments: Any) -> Any:
        seeded = [
            np.random.default_rng(a.integers(2**62)) if isinstance(a, np.random.Generator) else a
            for a in arguments
        ]
        return call(*seeded)

    return function


def _stacked(declared: Function, call: Call) -> Call:
    """Several results of one shape as one array."""

    def function(*arguments: Any) -> Any:
        value = call(*arguments)
        alike = (
            isinstance(value, tuple)
            and len({(np.shape(v), getattr(v, "dtype", None)) for v in value}) == 1
        )
        return np.array(value) if alike and isinstance(value[0], np.ndarray) else value

    return function if len(declared.results) > 1 else call


def _as_list(declared: Function, call: Call) -> Call:
    return lambda *a: list(call(*a)) if len(declared.results) > 1 else call(*a)


def _in_place(_: Function, call: Call) -> Call:
    """Works on copies of its own, and writes to them."""

    def function(*arguments: Any) -> Any:
        own = _copied(arguments)
        value = call(*own)
        several = isinstance(value, tuple)
        kept = tuple(np.array(v) for v in (value if several else (value,)))
        for array in own:
            if isinstance(array, np.ndarray) and array.flags.writeable:
                array[...] = 0
        return kept if several else kept[0] if isinstance(value, np.ndarray) else value

    return function


def _scattered(array: Array) -> Array:
    wide = np.zeros((*array.shape, 3), array.dtype)
    wide[..., 1] = array
    return wide[..., 1]


def _reversed(array: Array) -> Array:
    return array[::-1].copy()[::-1] if array.ndim else array


def _frozen(array: Array) -> Array:
    array = array.copy()
    array.flags.writeable = False
    return array


HABITS: dict[str, Habit] = {
    "as it is": lambda _, call: call,
    "double precision inside": _of_arguments(
        lambda a: a.astype(np.float64) if isinstance(a, np.ndarray) and a.dtype == np.float32 else a
    ),
    "extended precision inside": _of_arguments(
        lambda a: (
            a.astype(np.longdouble) if isinstance(a, np.ndarray) and a.dtype.kind == "f" else a
        )
    ),
    "results in Fortran's order": _of_results(np.asfortranarray),
    "results as a transpose's transpose": _of_results(lambda a: a.T.copy().T),
    "results as every third number of an array": _of_results(_scattered),
    "results that run backwards": _of_results(_reversed),
    "results that can't be written to": _of_results(_frozen),
    "results copied": _of_results(np.copy),
    "one column at a time": partial(_by_columns, at_once=1),
    "seven columns at a time": partial(_by_columns, at_once=7),
    "columns by halves": partial(_by_columns, at_once=150),
    "rows of u exchanged": _turning(lambda u: u[::-1]),
    "u the other way": _turning(_mirrored),
    "one row of u the other way": _turning(
        lambda u: np.concatenate((_mirrored(u[:1]), u[1:])) if u.ndim == 2 else _mirrored(u)
    ),
    "Fortran's order inside": _of_arguments(
        lambda a: np.asfortranarray(a) if isinstance(a, np.ndarray) and a.ndim else a
    ),
    "a generator of its own": _own_generator,
    "several results as one array": _stacked,
    "several results as a list": _as_list,
    "work on copies, in place": _in_place,
}


def lost_by(module: str, habit: str, seed: int) -> list[str]:
    """What the reference loses when all of its functions are written by a habit: the checks that fail, and why.

    Checks that render are left out.
    """
    effects = Effects(SOLUTIONS)
    functions = {name: effects.function(module, name) for name in COURSE[module]}
    caller = written(module, functions, habit)
    results = run_checks(
        module_checks(module),
        caller,
        lambda *_: {},
        seed,
        lambda check: check.kind not in ("picture", "bias", "speed"),
    )
    return [f"{r.id}: {r.found}" for r in results if r.status is not Status.PASSED]


def written(module: str, functions: dict[str, Call], habit: str) -> TrustedModule:
    """All functions of a module, by a habit."""
    change = HABITS[habit]
    return TrustedModule(
        {name: change(declared_function(module, name), call) for name, call in functions.items()}
    )
