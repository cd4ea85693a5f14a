"""quasi_monte_carlo declared: radical inverses, the two point sets made of them, and chained patterns.

Radical inverses are rational numbers, so what is asked of them is asked against exact fractions.
"""

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Role, Trial
from course.school.grading.checks.declare import (
    Arguments,
    Case,
    Function,
    Law,
    Made,
    count,
    function,
)
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.evenness import COUNTS, REPEATS, check_order
from course.school.grading.checks.laws import close, law
from course.school.grading.modules.chaining import CHAIN

CLOSE = 5e-7
"""What single precision may make of a coordinate, however it is added up."""

PRIMES = (
    *(2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89),
    *(97, 101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173),
)


def _law(
    name: str,
    title: str,
    look: Callable[[Arguments, Any], None],
    case: Case | None = None,
    times: int = 1,
    role: Role = "corner",
) -> Law:
    """A law on so many calls with 60 columns; there are no floats to be tried in double precision."""
    dtypes = (np.float32,)
    return law(name, title, look, role=role, case=case, n=60, scales=(1.0,) * times, dtypes=dtypes)


# ---------------------------------------------------------------- values


def _exact(base: int, i: int) -> Fraction:
    """The radical inverse as a fraction."""
    mirrored, size = 0, 1
    while i:
        i, digit = divmod(i, base)
        mirrored, size = mirrored * base + digit, size * base
    return Fraction(mirrored, size)


def _check_row(found: Array, base: int, i: Array, hint: str, coordinate: str = "") -> None:
    """Numbers are the radical inverses of i."""
    exact = [_exact(base, int(k)) for k in i]
    off = np.abs(found - np.array([float(x) for x in exact]))
    if off.size and not off.max() <= CLOSE:
        k = int(off.argmax())
        digits = f", in base {base} {np.base_repr(int(i[k]), base)}" if base <= 36 else ""
        raise Failure(
            f"{coordinate}in base {base}: {exact[k]} = {float(exact[k]):.7g}",
            f"{found[k]:.7g}",
            f"i = {i[k]}{digits}",
            hint,
        )


def _numbers(draw: Draw, most: int = 100_000) -> Array:
    """Numbers of any size, the first of all among them."""
    if draw.simple:
        return draw.rng.integers(0, 13, draw.n)
    i = draw.rng.integers(0, most, draw.n)
    i[:4] = np.arange(4)[: draw.n]
    return i


INDICES = Made(_numbers, (np.array([1.0, 2, 3, 4], np.float32), np.array([0, 1, -1, 2])))

OTHER_INDICES: Any = (
    lambda _: {"i": np.arange(40, dtype=np.int32)},
    lambda _: {"i": np.arange(40, dtype=np.uint8)},
    lambda _: {"i": np.array([0, 7, 2**32 - 1], np.uint32)},
)


# ---------------------------------------------------------------- radical_inverse


def _around_powers(draw: Draw) -> Mapping[str, Any]:
    bases = (2, 3, 10) if draw.simple else (2, 2, 3, 3, 5, 6, 7, 10, 13, 31, 97, 360, 1009, 65537)
    base = int(draw.rng.choice(bases))
    exponents = draw.rng.integers(1, 5 if base < 1000 else 2, draw.n)
    powers = base**exponents + draw.rng.integers(-1, 2, draw.n)
    return {"base": base, "i": np.where(draw.rng.random(draw.n) < 0.2, powers, _numbers(draw))}


def _large(draw: Draw) -> Mapping[str, Any]:
    i = draw.rng.integers(1 << 24, 1 << 32, draw.n)
    i[0] = (1 << 32) - 1
    return {"base": int(draw.rng.choice((2, 2, 2, 3))), "i": i}


def _small_kinds(draw: Draw) -> Mapping[str, Any]:
    """Numbers that bytes hold, and no larger."""
    kind, low = ((np.uint8, 128), (np.int8, 64), (np.uint16, 1 << 15))[draw.rng.integers(3)]
    i = draw.rng.integers(low, np.iinfo(kind).max, draw.n, kind, endpoint=True)
    return {"base": int(draw.rng.choice((2, 3, 10))), "i": i}


def _inverse(hint: str) -> Callable[[Arguments, Array], None]:
    return lambda a, r: _check_row(r, a.base, a.i, hint)


RADICAL_INVERSE = function(
    "quasi_monte_carlo.radical_inverse",
    {"base": count(2, 30, (1, 0, -2, 2.5, nan)), "i": INDICES},
    (
        _law(
            "large",
            "Large i have all their digits",
            _inverse("Take as many digits as i has."),
            _large,
            times=6,
        ),
        _law(
            "small_kinds",
            "Integers of few bits have all their digits",
            _inverse("A product or a sum of such integers may not fit in one."),
            _small_kinds,
            times=6,
        ),
        _law(
            "exact",
            "Digits are mirrored at the point",
            _inverse("The last digit before the point becomes the first behind it."),
            _around_powers,
            times=8,
            role="core",
        ),
    ),
    contract="base, i: N -> the radical inverses: float32 N",
    corners=OTHER_INDICES,
)

# ---------------------------------------------------------------- both point sets

TILT = np.array([0.6, -0.8, 0.5])
MEAN = float(np.prod(np.expm1(TILT) / TILT))
"""Of the exponential of the points along TILT, over the unit cube."""

EVEN = 0.75
"""Order of point sets: near 1, less powers of log N."""


def _order(points: Callable[[Function, Trial, int], Array]) -> Law:
    """The error of a mean over the function's own points, (3, REPEATS, N), falls nearly with 1 / N."""

    def run(function: Function, trial: Trial) -> None:
        errors = []
        for number_of in COUNTS:
            values = np.exp(np.tensordot(TILT, points(function, trial, number_of), 1))
            errors.append(float(np.sqrt(((values.mean(axis=1) - MEAN) ** 2).mean())))
        check_order(errors, EVEN, "Random points reach N^-0.5: yours are to be more even.")

    title = "The error of a mean falls nearly with 1 / N"
    return Law("order", title, run, kind="order", false_fail=1e-7)


def _check_cells(points: Array, columns: int, rows: int, hint: str) -> None:
    """Of the points one lies in each cell of a grid of as many."""
    counts = np.zeros((rows, columns), np.int64)
    # What single precision puts on a cell's border belongs to the cell above it.
    x, y = np.floor(points[:2] * [[columns], [rows]] + 0.001).astype(np.int64)
    np.add.at(counts, (np.clip(y, 0, rows - 1), np.clip(x, 0, columns - 1)), 1)
    if (counts != 1).any():
        row, column = (int(k) for k in np.argwhere(counts != 1)[0])
        raise Failure(
            f"one point in each cell of {columns} x {rows}",
            f"{counts[row, column]} in column {column}, row {row}",
            f"of {points.shape[1]} points",
            hint,
        )


# ---------------------------------------------------------------- halton


def _halton_coordinates(a: Arguments, r: Array) -> None:
    hint = "The bases are the primes in their order, one for each coordinate."
    for d, base in enumerate(PRIMES[: a.dims]):
        _check_row(r[d], base, a.i, hint, f"coordinate {d}, ")


def _halton_runs(draw: Draw) -> Mapping[str, Any]:
    """2^a 3^b points in a row, from a multiple of that on."""
    a, b = (1, 1) if draw.simple else draw.rng.choice(((3, 2), (5, 3), (2, 4)))
    n = int(2**a * 3**b)
    return {"i": n * int(draw.rng.integers(0, 3)) + np.arange(n), "dims": 2}


def _halton_cells(a: Arguments, r: Array) -> None:
    rows = 3
    while a.i.size % (3 * rows) == 0:
        rows *= 3
    _check_cells(r, a.i.size // rows, rows, "Bases 2 and 3 have no factor in common.")


def _runs(function: Function, trial: Trial, number_of: int) -> Array:
    """So many points in a row, wherever they begin."""
    i = trial.rng.integers(0, 1 << 20, REPEATS)[:, None] + np.arange(number_of)
    return np.reshape(function.call(trial, Arguments(i=i.ravel(), dims=3)), (3, *i.shape))


HALTON = function(
    "quasi_monte_carlo.halton",
    {"i": INDICES, "dims": count(1, 8, (0, -1))},
    (
        _law(
            "cells", "Points fall one into each cell of 2^a by 3^b", _halton_cells, _halton_runs, 3
        ),
        _order(_runs),
        _law(
            "many_primes",
            "There are as many primes as coordinates",
            _halton_coordinates,
            lambda _: {"dims": len(PRIMES)},
        ),
        _law(
            "exact",
            "Coordinates are radical inverses in the primes",
            _halton_coordinates,
            lambda d: {"dims": 5 if d.simple else 15},
            role="core",
        ),
    ),
    corners=OTHER_INDICES,
)

# ---------------------------------------------------------------- hammersley


def _hammersley_coordinates(a: Arguments, r: Array) -> None:
    i = np.arange(a.n)
    off = np.abs(r[0] - i / a.n)
    k = int(off.argmax())
    # What is off by less is the business of "first".
    if off[k] > 2 / a.n:
        hint = "The first coordinate just counts."
        came = f"{r[0, k]:.7g}"
        raise Failure(f"coordinate 0: {k / a.n:.7g}", came, f"i = {k}, n = {a.n}", hint)
    for d, base in enumerate(PRIMES[: a.dims - 1], 1):
        hint = "The primes begin with 2 after the coordinate that counts."
        _check_row(r[d], base, i, hint, f"coordinate {d}, ")


def _any_number(draw: Draw) -> Mapping[str, Any]:
    low, high = (2, 5) if draw.simple else (50, 400)
    return {"n": int(draw.rng.integers(low, high)), "dims": 3 if draw.simple else 8}


def _hammersley_cells(a: Arguments, r: Array) -> None:
    digits = a.n.bit_length() - 1
    hint = "In base 2, all grids of as many cells as there are points have one in each."
    for wide in range(digits + 1):
        _check_cells(r, 2**wide, 2 ** (digits - wide), hint)


def _moved(function: Function, trial: Trial, number_of: int) -> Array:
    """The set, moved by random vectors around the unit cube."""
    points = function.call(trial, Arguments(n=number_of, dims=3))
    return np.asarray((points[:, None] + trial.rng.random((3, REPEATS, 1))) % 1)


HAMMERSLEY = function(
    "quasi_monte_carlo.hammersley",
    {"n": Made(lambda d: d.n, (-1,)), "dims": count(1, 8, (0, -1))},
    (
        _law(
            "cells",
            "2^m points fall one into each cell of all grids of 2^m cells",
            _hammersley_cells,
            lambda d: {"n": 2 ** int(d.rng.integers(2 if d.simple else 5, 9)), "dims": 2},
        ),
        close(
            "first",
            "Coordinate 0 is i / n",
            lambda a, r: (r[0], np.arange(a.n) / a.n),
            "The first coordinate just counts, from 0 on.",
            what="coordinate 0: i / n =",
            within=0,
            floor=CLOSE,
            case=_any_number,
        ),
        _order(_moved),
        _law(
            "exact",
            "Coordinate 0 counts, the others are radical inverses",
            _hammersley_coordinates,
            _any_number,
            times=2,
            role="core",
        ),
    ),
    corners=(lambda _: {"n": 0, "dims": 1},),
)

FUNCTIONS = (RADICAL_INVERSE, HALTON, HAMMERSLEY, CHAIN)
