"""Checks of the quasi_monte_carlo module: radical inverses, the two point sets made of them, and chained patterns.

Radical inverses are rational numbers, so what is asked of them is asked against exact fractions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from itertools import permutations
from math import nan
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    check_array,
    check_refused,
    check_seeded,
    check_untouched,
    contract_checks,
    finite_floats,
    near,
)
from course.grading.checks.statistics import chi_squared, distribution_check

CLOSE = 5e-7
"""What single precision may make of a coordinate, however it is added up."""

PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47)


# ---------------------------------------------------------------- values


def _exact(base: int, i: int) -> Fraction:
    """The radical inverse as a fraction."""
    mirrored, size = 0, 1
    while i:
        i, digit = divmod(i, base)
        mirrored, size = mirrored * base + digit, size * base
    return Fraction(mirrored, size)


def _expected(base: int, i: Array) -> list[Fraction]:
    return [_exact(base, int(k)) for k in i]


def _digits(base: int, i: int) -> str:
    digits: list[str] = []
    while i:
        i, digit = divmod(i, base)
        digits.insert(0, str(digit))
    return " ".join(digits) or "0"


def _check_row(found: Array, base: int, i: Array, what: str, hint: str) -> None:
    """Coordinates are the radical inverses of i."""
    exact = _expected(base, i)
    off = np.abs(found - np.array([float(x) for x in exact]))
    if off.size and not off.max() <= CLOSE:
        k = int(off.argmax())
        raise Failure(
            f"{what} {exact[k]} = {float(exact[k]):.7g}",
            f"{found[k]:.7g}",
            f"i = {i[k]}, in base {base}: {_digits(base, int(i[k]))}",
            hint,
        )


def _check_below_1(value: Array) -> None:
    if value.size and not (value.min() >= 0 and value.max() <= 1):
        raise Failure("numbers in [0, 1)", f"{value.min():.7g} to {value.max():.7g}")


def _indices(trial: Trial, n: int, most: int = 100_000) -> Array:
    return np.concatenate(([0, 1, 2, 3], trial.rng.integers(0, most, n)))


# ---------------------------------------------------------------- radical_inverse


def _inverse(trial: Trial, base: int, i: Array) -> Array:
    return finite_floats(trial.call(base, i.copy()), i.shape, "the radical inverses")


def _bases(trial: Trial) -> tuple[int, ...]:
    return 2, 3, 5, 10, int(trial.rng.choice(PRIMES[5:])), int(trial.rng.integers(51, 500))


def _inverse_contract(trial: Trial) -> None:
    i = _indices(trial, 50)
    for dtype in (np.int64, np.int32, np.uint32):
        for batch in (i.astype(dtype), i[:1].astype(dtype), i[:0].astype(dtype)):
            for base in (2, 3, 100):
                value = trial.call(base, batch)
                _check_below_1(check_array(value, batch.shape, np.float32, "the radical inverses"))


def _inverse_untouched(trial: Trial) -> None:
    check_untouched(trial, 3, _indices(trial, 50))


def _check_indices_refused(
    trial: Trial, name: str, *, before: tuple[Any, ...], after: tuple[Any, ...]
) -> None:
    i = _indices(trial, 4)
    for bad in (i[None], i.reshape(2, 4), i[0]):
        check_refused(trial, *before, bad, *after, named=f"{name} (its shape)")
    check_refused(trial, *before, i.astype(np.float32), *after, named=f"{name} (floating)")
    check_refused(trial, *before, i - 1, *after, named=f"{name} (-1)")


def _inverse_refuses(trial: Trial) -> None:
    _check_indices_refused(trial, "i", before=(2,), after=())
    for base in (1, 0, -2, 2.5, nan):
        check_refused(trial, base, _indices(trial, 4), named=f"base {base}")


def _inverse_exact(trial: Trial) -> None:
    hint = "The last digit before the point becomes the first behind it."
    for base in _bases(trial):
        powers = [base**k + d for k in range(1, 5) for d in (-1, 0, 1)]
        i = np.concatenate((_indices(trial, 60), powers))
        _check_row(_inverse(trial, base, i), base, i, f"in base {base}", hint)


def _inverse_large(trial: Trial) -> None:
    hint = "Take as many digits as i has."
    i = trial.rng.integers(1 << 24, 1 << 32, 60)
    i[0] = (1 << 32) - 1
    for base in (2, 3, 7):
        value = _inverse(trial, base, i)
        _check_below_1(value)
        _check_row(value, base, i, f"in base {base}", hint)


def _inverse_strata(trial: Trial) -> None:
    for base, digits in ((2, 8), (3, 5), (int(trial.rng.choice((5, 7, 11))), 2)):
        n = base**digits
        # Any run of that many whose beginning is a multiple of it.
        start = n * int(trial.rng.integers(0, 50))
        cells = np.floor(_inverse(trial, base, np.arange(start, start + n)) * n + 0.001)
        counts = np.bincount(np.clip(cells, 0, n - 1).astype(np.int64), minlength=n)
        if (counts != 1).any():
            k = int(np.argmax(counts != 1))
            raise Failure(
                f"one number in each {n}th of [0, 1)",
                f"{counts[k]} in part {k}",
                f"base {base}, i from {start} to {start + n - 1}",
                f"Those i have all endings of {digits} digits, each once.",
            )


# ---------------------------------------------------------------- halton


def _halton(trial: Trial, i: Array, dims: int) -> Array:
    points = finite_floats(trial.call(i, dims), (dims, i.size), "the points")
    if dims > 1:
        trial.show("points", "your points, coordinates 0 and 1", yours=points[:2, :2000])
    return points


def _halton_contract(trial: Trial) -> None:
    i = _indices(trial, 50)
    for dims in (1, 2, int(trial.rng.integers(3, 9))):
        for batch in (i, i[:1].copy(), i[:0].copy(), i.astype(np.uint32)):
            _check_below_1(
                check_array(trial.call(batch, dims), (dims, batch.size), np.float32, "the points")
            )


def _halton_untouched(trial: Trial) -> None:
    check_untouched(trial, _indices(trial, 50), 3)


def _halton_refuses(trial: Trial) -> None:
    _check_indices_refused(trial, "i", before=(), after=(2,))
    for dims in (0, -1):
        check_refused(trial, _indices(trial, 4), dims, named=f"dims {dims}")


def _halton_exact(trial: Trial) -> None:
    i = _indices(trial, 40)
    points = _halton(trial, i, len(PRIMES))
    hint = "The bases are the primes in their order, one for each coordinate."
    for d, base in enumerate(PRIMES):
        _check_row(points[d], base, i, f"coordinate {d}, in base {base}:", hint)


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


def _halton_cells(trial: Trial) -> None:
    for a, b in ((3, 2), (5, 3), (2, 4)):
        n = 2**a * 3**b
        start = n * int(trial.rng.integers(0, 3))
        points = _halton(trial, np.arange(start, start + n), 2)
        _check_cells(points, 2**a, 3**b, "Bases 2 and 3 have no factor in common.")


# ---------------------------------------------------------------- hammersley


def _hammersley(trial: Trial, n: int, dims: int) -> Array:
    points = finite_floats(trial.call(n, dims), (dims, n), "the points")
    if dims > 1:
        trial.show("points", "your points, coordinates 0 and 1", yours=points[:2, :2000])
    return points


def _hammersley_contract(trial: Trial) -> None:
    for dims in (1, 2, int(trial.rng.integers(3, 9))):
        for n in (int(trial.rng.integers(2, 200)), 1, 0):
            _check_below_1(
                check_array(trial.call(n, dims), (dims, n), np.float32, f"n = {n}: points")
            )


def _hammersley_untouched(trial: Trial) -> None:
    check_untouched(trial, 20, 3)


def _hammersley_refuses(trial: Trial) -> None:
    for n, dims in ((-1, 2), (4, 0), (4, -1)):
        check_refused(trial, n, dims, named=f"n or dims (n = {n}, dims = {dims})")


def _hammersley_exact(trial: Trial) -> None:
    n = int(trial.rng.integers(50, 400))
    dims = 8
    points = _hammersley(trial, n, dims)
    i = np.arange(n)
    off = np.abs(points[0] - i / n)
    k = int(off.argmax())
    if not off[k] <= CLOSE:
        raise Failure(
            f"coordinate 0: i / n = {k / n:.7g}",
            f"{points[0, k]:.7g}",
            f"i = {k}, n = {n}",
            "The first coordinate just counts.",
        )
    for d in range(1, dims):
        base = PRIMES[d - 1]
        hint = "The primes begin with 2 after the coordinate that counts."
        _check_row(points[d], base, i, f"coordinate {d}, in base {base}:", hint)


def _hammersley_cells(trial: Trial) -> None:
    digits = int(trial.rng.integers(5, 9))
    points = _hammersley(trial, 2**digits, 2)
    for wide in range(digits + 1):
        hint = "In base 2, all grids of as many cells as there are points have one in each."
        _check_cells(points, 2**wide, 2 ** (digits - wide), hint)


def _hammersley_better(trial: Trial) -> None:
    n = int(trial.rng.integers(500, 1500))
    x, y, z = _hammersley(trial, n, 3)
    error = abs(float((x * y * z).mean()) - 1 / 8)
    # Random points have a standard error of 0.146 / sqrt(n).
    bound = 6 * float(np.log(n)) ** 2 / n / 8
    if not error <= bound:
        raise Failure(
            f"the mean of x y z, 1/8, within {bound:.2g}",
            f"{error + 1 / 8:.6g} or {1 / 8 - error:.6g}",
            f"n = {n}",
            "Evenly spread points integrate a smooth function with an error near 1 / n.",
        )


# ---------------------------------------------------------------- chain

ROWS = (2, 2, 1, 3)
"""Lens, light, time, gloss."""


def _patterns(trial: Trial, s: int, dtypes: Sequence[Any] = (np.float32,) * 4) -> tuple[Array, ...]:
    """All numbers of all patterns are different, so that what was taken can be told."""
    values = (trial.rng.permutation(sum(ROWS) * s) + 0.5) / (sum(ROWS) * s)
    parts = np.split(values.reshape(-1, s), np.cumsum(ROWS)[:-1])
    return tuple(part.astype(dtype) for part, dtype in zip(parts, dtypes, strict=True))


def _chained(
    trial: Trial, patterns: tuple[Array, ...], ids: Array, rng: np.random.Generator | None = None
) -> list[Array]:
    # Copies, so that writing to them costs the check for that alone.
    value = trial.call(tuple(p.copy() for p in patterns), ids.copy(), rng or trial.generator())
    return _taken(value, patterns, ids.size)


def _taken(value: Any, patterns: tuple[Array, ...], n: int) -> list[Array]:
    if not isinstance(value, tuple | list) or len(value) != len(patterns):
        length = f" of {len(value)}" if isinstance(value, tuple | list) else ""
        raise Failure(f"a tuple of {len(patterns)} arrays", f"{type(value).__name__}{length}")
    return [
        finite_floats(array, (len(pattern), n), f"samples of pattern {k}")
        for k, (array, pattern) in enumerate(zip(value, patterns, strict=True))
    ]


def _chain_contract(trial: Trial) -> None:
    for dtypes in ((np.float32,) * 4, (np.float64,) * 4, (np.float32, np.float64) * 2):
        patterns = _patterns(trial, 9, dtypes)
        for n in (30, 1, 0):
            ids = trial.rng.integers(0, 9, n)
            value = trial.call(patterns, ids, trial.generator())
            _taken(value, patterns, n)
            for k, (array, pattern) in enumerate(zip(value, patterns, strict=True)):
                check_array(array, (len(pattern), n), pattern.dtype, f"samples of pattern {k}")
    one = _patterns(trial, 1)
    _chained(trial, one[:1], np.zeros(3, np.int64))


def _chain_untouched(trial: Trial) -> None:
    patterns, ids = _patterns(trial, 9), np.arange(9)
    check_untouched(trial, patterns, ids, trial.generator())
    before = [pattern.copy() for pattern in patterns]
    _, after, _ = trial.caller.call_and_look(trial.function, patterns, ids, trial.generator())
    for k, (old, new) in enumerate(zip(before, after[0], strict=True)):
        if not np.array_equal(old, new):
            raise Failure(
                f"pattern {k} to be left as it was",
                "it has been written to",
                hint="Other pixels need the pattern as well; work on a copy.",
            )


def _chain_refuses(trial: Trial) -> None:
    patterns = _patterns(trial, 5)
    ids = np.arange(5)
    for wrong in ((patterns[0][0],), (*patterns[:2], patterns[2][:, :4]), (patterns[0][None],)):
        check_refused(trial, wrong, ids, trial.generator(), named="patterns (a shape)")
    for bad, why in (
        (ids[None], "its shape"),
        (ids.astype(np.float64), "floating"),
        (ids - 1, "-1"),
        (ids + 1, "s itself"),
    ):
        check_refused(trial, patterns, bad, trial.generator(), named=f"ids ({why})")


def _index(array: Array, pattern: Array) -> Array:
    """Which of the pattern's samples each column is; -1 where it is none."""
    same = (array[:, :, None] == pattern.astype(np.float64)[:, None, :]).all(axis=0)
    return np.where(same.any(axis=1), same.argmax(axis=1), -1)


def _chain_samples(trial: Trial) -> None:
    s = int(trial.rng.integers(5, 17))
    patterns = _patterns(trial, s)
    for k, array in enumerate(_chained(trial, patterns, trial.rng.integers(0, s, 60))):
        index = _index(array, patterns[k])
        if (index < 0).any():
            column = int(np.argmax(index < 0))
            found = ", ".join(f"{x:.5g}" for x in array[:, column])
            raise Failure(
                f"each column to be a sample of pattern {k}, bit for bit",
                f"({found}), which is none",
                f"ray {column}",
                "The coordinates of a sample stay together.",
            )


def _chain_once(trial: Trial) -> None:
    s = int(trial.rng.integers(5, 17))
    patterns = _patterns(trial, s)
    ids = trial.rng.permutation(s)
    for k, array in enumerate(_chained(trial, patterns, ids)):
        counts = np.bincount(_index(array, patterns[k]) + 1, minlength=s + 1)[1:]
        if (counts != 1).any():
            sample = int(np.argmax(counts != 1))
            raise Failure(
                f"the {s} rays of a pixel to take each sample of pattern {k} once",
                f"sample {sample} is taken {counts[sample]} times",
                hint="A permutation leaves nothing out.",
            )


def _chain_by_id(trial: Trial) -> None:
    s = int(trial.rng.integers(5, 17))
    patterns = _patterns(trial, s)
    ids = np.concatenate((np.arange(s), trial.rng.integers(0, s, 50)))
    for k, array in enumerate(_chained(trial, patterns, ids)):
        other = (array != array[:, ids]).any(axis=0)
        if other.any():
            ray = int(np.argmax(other))
            raise Failure(
                f"equal ids to take equal samples of pattern {k}",
                f"rays {ids[ray]} and {ray} have the id {ids[ray]} and take different ones",
                hint="In a call, each pattern has one permutation, which the id looks up.",
            )


def _chain_from_rng(trial: Trial) -> None:
    patterns, ids = _patterns(trial, 16), np.arange(16)
    check_seeded(trial, lambda rng: np.concatenate(_chained(trial, patterns, ids, rng)), "samples")


MANY = 1440
ORDERS = {order: k for k, order in enumerate(permutations(range(3)))}
"""A number for each of the six permutations of three samples."""


def _permutations(trial: Trial) -> Array:
    """The permutation of each of many patterns of three samples, by number."""
    patterns = (np.array([[0.25, 0.5, 0.75]], np.float32),) * MANY
    arrays = np.concatenate(_chained(trial, patterns, np.arange(3)))
    taken = [tuple(row) for row in (arrays * 4 - 1).astype(np.int64).tolist()]
    for k, order in enumerate(taken):
        if order not in ORDERS:
            raise Failure(f"a permutation of pattern {k}", f"samples {order}")
    return np.array([ORDERS[order] for order in taken])


def _chain_uniform(trial: Trial) -> None:
    counts = np.bincount(_permutations(trial), minlength=6)
    chi_squared(
        counts,
        np.full(6, MANY / 6),
        "how often each permutation of three samples comes",
        "All orders are equally probable.",
    )


def _chain_independent(trial: Trial) -> None:
    first, second = _permutations(trial).reshape(-1, 2).T
    counts = np.bincount(6 * first + second, minlength=36)
    chi_squared(
        counts,
        np.full(36, MANY / 2 / 36),
        "how often two patterns have each pair of permutations",
        "Where one pattern's sample is must tell nothing of the other's.",
    )


# ---------------------------------------------------------------- mistakes


_near = partial(near, tolerance=1e-6)


def _row(base: int, i: Array) -> list[float]:
    return [float(x) for x in _expected(base, i)]


def _inverse_is(trial: Trial, mistaken: Callable[[int, Array], Sequence[float]]) -> bool:
    i = trial.rng.integers(20, 5000, 50)
    return all(_near(_inverse(trial, b, i), mistaken(b, i)) for b in (2, 3, 5))


def _not_mirrored(base: int, i: Array) -> list[float]:
    """The digits behind the point in the order in which they stood before it."""
    sizes = [base ** len(_digits(base, int(k)).split()) for k in i]
    return [int(k) / size for k, size in zip(i, sizes, strict=True)]


def _halton_is(trial: Trial, bases: Sequence[int], first: int = 0) -> bool:
    i = trial.rng.integers(20, 5000, 40)
    points = _halton(trial, i, len(bases))
    return all(_near(points[d], _row(b, i + first)) for d, b in enumerate(bases))


def _hammersley_is(
    trial: Trial, first: Callable[[Array, int], Any], bases: Sequence[int] = (2, 3, 5)
) -> bool:
    n = 90
    i = np.arange(n)
    points = _hammersley(trial, n, len(bases) + 1)
    rest = all(_near(points[d + 1], _row(b, i)) for d, b in enumerate(bases))
    return rest and _near(points[0], first(i, n))


def _taken_by(trial: Trial) -> list[Array]:
    """Which sample each ray of a pixel takes of each pattern."""
    patterns = _patterns(trial, 32)
    arrays = _chained(trial, patterns, np.arange(32))
    return [_index(array, pattern) for array, pattern in zip(arrays, patterns, strict=True)]


def _chain_unpermuted(trial: Trial) -> bool:
    return all((index == np.arange(32)).all() for index in _taken_by(trial))


def _chain_all_alike(trial: Trial) -> bool:
    taken = _taken_by(trial)
    alike = all(np.array_equal(index, taken[0]) for index in taken)
    return alike and not bool((taken[0] == np.arange(32)).all())


def _chain_shifted(trial: Trial) -> bool:
    """Each pattern is rotated, not permuted."""
    return all(len(set(((index - np.arange(32)) % 32).tolist())) == 1 for index in _taken_by(trial))


def _chain_apart(trial: Trial) -> bool:
    """Each row is a permutation by itself, but samples are torn apart."""
    patterns = _patterns(trial, 32)
    arrays = _chained(trial, patterns, np.arange(32))
    rows = all(
        np.array_equal(np.sort(array, axis=1), np.sort(pattern, axis=1))
        for array, pattern in zip(arrays, patterns, strict=True)
    )
    return rows and bool((_index(arrays[0], patterns[0]) < 0).any())


def _chain_with_repeats(trial: Trial) -> bool:
    taken = _taken_by(trial)
    return all(index.min() >= 0 and len(set(index.tolist())) < 32 for index in taken)


def _chain_ids_ignored(trial: Trial) -> bool:
    patterns = _patterns(trial, 32)
    same = np.full(32, 5)
    arrays = _chained(trial, patterns, same)
    return all(len(set(array[0].tolist())) > 1 for array in arrays)


# ---------------------------------------------------------------- all of it


CHECKS = ModuleChecks(
    "quasi_monte_carlo",
    checks=(
        *contract_checks(
            "radical_inverse", _inverse_contract, _inverse_untouched, _inverse_refuses
        ),
        Check("radical_inverse", "exact", "Digits are mirrored at the point", _inverse_exact),
        Check("radical_inverse", "large", "Large i have all their digits", _inverse_large),
        Check(
            "radical_inverse",
            "strata",
            "base^m numbers in a row fall one into each part",
            _inverse_strata,
        ),
        *contract_checks("halton", _halton_contract, _halton_untouched, _halton_refuses),
        Check("halton", "exact", "Coordinates are radical inverses in the primes", _halton_exact),
        Check("halton", "cells", "Points fall one into each cell of 2^a by 3^b", _halton_cells),
        *contract_checks(
            "hammersley", _hammersley_contract, _hammersley_untouched, _hammersley_refuses
        ),
        Check(
            "hammersley",
            "exact",
            "Coordinate 0 is i / n, the others are radical inverses",
            _hammersley_exact,
        ),
        Check(
            "hammersley",
            "cells",
            "2^m points fall one into each cell of all grids of 2^m cells",
            _hammersley_cells,
        ),
        Check(
            "hammersley",
            "integral",
            "A mean over the points is far better than one over random ones",
            _hammersley_better,
        ),
        *contract_checks("chain", _chain_contract, _chain_untouched, _chain_refuses),
        Check("chain", "samples", "Rays take whole samples of each pattern", _chain_samples),
        Check("chain", "once", "The rays of a pixel take each sample once", _chain_once),
        Check("chain", "by_id", "Equal ids take equal samples", _chain_by_id),
        Check("chain", "from_rng", "The generator alone decides", _chain_from_rng),
        distribution_check(
            "chain",
            "uniform",
            "All permutations of a pattern are equally probable",
            _chain_uniform,
            1,
        ),
        distribution_check(
            "chain",
            "decorrelated",
            "The permutations of two patterns are independent",
            _chain_independent,
            1,
        ),
    ),
    mistakes=(
        Mistake(
            "radical_inverse",
            "not-mirrored",
            "Your digits stand behind the point in the order in which they stood before it.",
            partial(_inverse_is, mistaken=_not_mirrored),
        ),
        Mistake(
            "radical_inverse",
            "one-too-far",
            "You give the radical inverse of i + 1.",
            partial(_inverse_is, mistaken=lambda b, i: _row(b, i + 1)),
        ),
        Mistake(
            "radical_inverse",
            "always-base-2",
            "Your base is 2, whichever is asked for.",
            partial(_inverse_is, mistaken=lambda _, i: _row(2, i)),
        ),
        Mistake(
            "radical_inverse",
            "first-digit-whole",
            "Your first digit stands before the point: the numbers are base times too large.",
            partial(_inverse_is, mistaken=lambda b, i: [b * x for x in _row(b, i)]),
        ),
        Mistake(
            "halton",
            "bases-not-prime",
            "Your bases are 2, 3, 4, 5, ...: where they share a factor, coordinates are tied to each other.",
            partial(_halton_is, bases=(2, 3, 4, 5, 6)),
        ),
        Mistake(
            "halton",
            "odd-bases",
            "Your bases are 2 and the odd numbers; 9 is one, but it is no prime.",
            partial(_halton_is, bases=(2, 3, 5, 7, 9, 11)),
        ),
        Mistake(
            "halton",
            "one-base",
            "All your coordinates have the same base, so the points lie on the diagonal.",
            partial(_halton_is, bases=(2, 2, 2)),
        ),
        Mistake(
            "halton",
            "next-point",
            "You give the point that follows: point 0 has all coordinates 0.",
            partial(_halton_is, bases=(2, 3, 5), first=1),
        ),
        Mistake(
            "halton",
            "first-prime-missing",
            "Your primes begin with 3; they begin with 2.",
            partial(_halton_is, bases=(3, 5, 7)),
        ),
        Mistake(
            "hammersley",
            "centred",
            "Your first coordinate is (i + 1/2) / n; here it is i / n.",
            partial(_hammersley_is, first=lambda i, n: (i + 0.5) / n),
        ),
        Mistake(
            "hammersley",
            "up-to-1",
            "Your first coordinate is i / (n - 1), which reaches 1.",
            partial(_hammersley_is, first=lambda i, n: i / (n - 1)),
        ),
        Mistake(
            "hammersley",
            "halton-instead",
            "These are Halton's points: the first coordinate should be i / n.",
            partial(_hammersley_is, first=lambda i, _: _row(2, i), bases=(3, 5, 7)),
        ),
        Mistake(
            "hammersley",
            "base-2-skipped",
            "You skip base 2: after the coordinate that counts, the primes begin with 2.",
            partial(_hammersley_is, first=lambda i, n: i / n, bases=(3, 5, 7)),
        ),
        Mistake(
            "chain",
            "not-permuted",
            "Your ray takes the sample of its own id from each pattern: the effects are tied to each other.",
            _chain_unpermuted,
        ),
        Mistake(
            "chain",
            "one-permutation",
            "All patterns have the same permutation, so the effects are as tied to each other as before.",
            _chain_all_alike,
        ),
        Mistake(
            "chain",
            "only-rotated",
            "Your patterns are rotated by a random number of samples: neighbours stay neighbours.",
            _chain_shifted,
        ),
        Mistake(
            "chain",
            "coordinates-torn-apart",
            "Each row has a permutation of its own, which tears the coordinates of a sample apart.",
            _chain_apart,
        ),
        Mistake(
            "chain",
            "ids-ignored",
            "Rays of the same id take different samples: the id doesn't decide.",
            _chain_ids_ignored,
        ),
        Mistake(
            "chain",
            "with-repeats",
            "You draw samples with repetition: a pixel takes some twice and others never.",
            _chain_with_repeats,
        ),
    ),
)
