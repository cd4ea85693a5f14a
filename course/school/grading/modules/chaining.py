"""quasi_monte_carlo.chain declared: patterns made beforehand, permuted so that a ray's id picks samples of its own.

Which permutations are drawn is the function's own business; what is asked is asked of the samples that rays take.
"""

from collections.abc import Iterator, Mapping
from copy import deepcopy
from itertools import permutations
from math import factorial
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import Arguments, Function, Law, Made, function
from course.school.grading.checks.distributions import FALSE_FAIL, chi_squared
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import from_generator, holds

ROWS = (2, 2, 1, 3)
"""Lens, light, time, gloss."""

MIXED = (np.float32, np.float64, np.float32, np.float64)
"""Each has a dtype of its own."""

FOUR = ", ".join(
    f"samples of pattern {k}: {np.dtype(dtype)} {rows} N"
    for k, (rows, dtype) in enumerate(zip(ROWS, MIXED, strict=True))
)
"""Of the contract what holds for four patterns."""


def _patterns(draw: Draw, s: int) -> tuple[Array, ...]:
    """All numbers of all patterns are different, so that what was taken can be told; single precision holds them."""
    values = (draw.rng.permutation(sum(ROWS) * s) + 0.5) / 256
    parts = np.split(values.reshape(-1, s), np.cumsum(ROWS)[:-1])
    return tuple(part.astype(dtype) for part, dtype in zip(parts, MIXED, strict=True))


def _rays(draw: Draw) -> Mapping[str, Any]:
    """Any rays of a pixel."""
    s = int(draw.rng.integers(2, 4) if draw.simple else draw.rng.integers(5, 17))
    return {"patterns": _patterns(draw, s), "ids": draw.rng.integers(0, s, draw.n)}


def _pixel(draw: Draw) -> Mapping[str, Any]:
    """Each ray of a pixel, in any order."""
    given = _rays(draw)
    return {**given, "ids": draw.rng.permutation(given["patterns"][0].shape[1])}


def _index(array: Array, pattern: Array) -> Array:
    """Which of the pattern's samples each column is; -1 where it is none."""
    same = (array[:, :, None] == pattern.astype(np.float64)[:, None, :]).all(axis=0)
    return np.where(same.any(axis=1), same.argmax(axis=1), -1)


def _taken(a: Arguments, r: Any) -> Array:
    """(4, N): which sample of each pattern the rays have."""
    return np.stack([_index(array, pattern) for array, pattern in zip(r, a.patterns, strict=True)])


def _first(a: Arguments) -> Array:
    """Of each ray, the first one that has its id."""
    _, first, of = np.unique(a.ids, return_index=True, return_inverse=True)
    return np.asarray(first[of])


def _shared(a: Arguments, r: Any) -> Array:
    """How many rays have the same sample as each ray, of each pattern."""
    taken = _taken(a, r)
    return np.asarray((taken[:, :, None] == taken[:, None, :]).sum(axis=2))


def _rays_law(name: str, title: str, true: Any, says: str, hint: str, **how: Any) -> Law:
    return holds(name, title, true, says, hint, n=60, **how)


CALLS, MOST = 240, 32
"""Of the function, and samples of a pattern."""


def _drawn(function: Function, trial: Trial, s: int) -> Iterator[Array]:
    """CALLS times (4, s): which of s samples of each pattern the rays have."""
    for _ in range(CALLS):
        patterns = _patterns(Draw(trial.rng, 3), s)
        a = Arguments(patterns=patterns, ids=np.arange(s), rng=trial.generator())
        yield _taken(a, function.call(trial, deepcopy(a)))


def _placed(function: Function, trial: Trial, s: int) -> Array:
    """(s * s,): how often each ray has each sample; what is none is left out."""
    pairs = s * np.arange(s) + np.concatenate(list(_drawn(function, trial, s))).astype(int)
    return np.bincount(pairs[pairs >= 0], minlength=s * s)


def _permutations(function: Function, trial: Trial, s: int) -> Array:
    """(CALLS, 4): the permutation of each pattern of s samples, by number."""
    orders = {order: k for k, order in enumerate(permutations(range(s)))}
    found = []
    for call in _drawn(function, trial, s):
        for k, taken in enumerate(call.tolist()):
            if tuple(taken) not in orders:
                found_of = ", ".join("none" if one < 0 else str(one) for one in taken)
                expected = (
                    f"rays 0 to {s - 1} to have samples 0 to {s - 1} of pattern {k}, in any order"
                )
                raise Failure(expected, f"samples {found_of}")
            found.append(orders[tuple(taken)])
    return np.reshape(found, (CALLS, len(ROWS)))


def _counted(function: Function, trial: Trial, s: int) -> Array:
    taken, count = _permutations(function, trial, s), factorial(s)
    chi_squared(
        np.bincount(taken.ravel(), minlength=count),
        np.full(count, taken.size / count),
        f"how often each permutation of {s} samples comes",
        "All orders are equally probable.",
    )
    return taken


def _other_sizes(function: Function, trial: Trial) -> None:
    # Of three samples all permutations are turns and mirror images; of four most aren't.
    for s in (2, 4):
        _counted(function, trial, s)
    # A shuffle that swaps each sample with any other is hardly uneven for a few, and more so for many.
    chi_squared(
        _placed(function, trial, MOST),
        np.full(MOST**2, CALLS * len(ROWS) / MOST),
        f"how often each ray has each of {MOST} samples",
        "All orders are equally probable: a sample that has its place takes no part in further swaps.",
    )


def _untied(function: Function, trial: Trial) -> None:
    taken = _counted(function, trial, 3)
    first, second = taken.reshape(-1, 2).T
    chi_squared(
        np.bincount(6 * first + second, minlength=36),
        np.full(36, taken.size / 2 / 36),
        "how often two patterns have each pair of permutations",
        "Where one pattern's sample is must tell nothing of the other's.",
    )


def _ways(a: Arguments, r: Any) -> Array:
    """How samples were chosen, as yes and no, whatever numbers were drawn."""
    taken, first = _taken(a, r), _first(a)
    by_turns = (taken - a.ids) % a.patterns[0].shape[1]
    pairs = zip(r, a.patterns, strict=True)
    rows = all(np.isin(*both).all() for parts in pairs for both in zip(*parts, strict=True))
    told = (
        (taken >= 0).all(),
        (taken == taken[:, first]).all(),
        all(len(set(row)) == len(set(first)) for row in taken[:, first].tolist()),
        (by_turns == by_turns[:, :1]).all(),
        (taken == a.ids).all(),
        (taken == taken[0]).all(),
    )
    # What is torn apart has no samples to tell of, but rows of them.
    ways = np.array((rows, *(told if told[0] else (0,) * 6)), float)
    return np.repeat(ways[:, None], 100, axis=1)


CHAIN = function(
    "quasi_monte_carlo.chain",
    {
        "patterns": Made(
            wrong=tuple(
                {
                    "patterns": tuple(np.zeros(shape, np.float32) for shape in shapes),
                    "ids": np.zeros(2, int),
                }
                for shapes in (((3,),), ((2, 3), (1, 2)), ((1, 2, 3),))
            )
        ),
        "ids": Made(
            wrong=(np.zeros(4, np.float32), np.array([0, 1, -1, 0]), np.array([0, 1, 99, 0]))
        ),
    },
    (
        _rays_law(
            "samples",
            "Rays take whole samples of each pattern",
            lambda a, r: (_taken(a, r) >= 0).all(axis=0),
            "a sample of each pattern, bit for bit",
            "The coordinates of a sample stay together.",
        ),
        _rays_law(
            "once",
            "The rays of a pixel take each sample once",
            lambda a, r: (_shared(a, r) == 1).all(axis=0),
            "each ray of a pixel to have samples that no other has",
            "A permutation leaves nothing out.",
            case=_pixel,
        ),
        _rays_law(
            "by_id",
            "Equal ids take equal samples",
            lambda a, r: (_taken(a, r) == _taken(a, r)[:, _first(a)]).all(axis=0),
            "the samples that the first ray of the same id has",
            "In a call, each pattern has one permutation, which the id looks up.",
        ),
        from_generator(),
        Law(
            "sizes",
            "Patterns of two, of four and of many samples have any permutation, too",
            _other_sizes,
            "corner",
            "distribution",
            false_fail=3 * FALSE_FAIL,
        ),
        Law(
            "decorrelated",
            "Each pattern has any permutation, whichever another has",
            _untied,
            "core",
            "distribution",
            false_fail=2 * FALSE_FAIL,
        ),
    ),
    case=_rays,
    corners=(
        lambda _: {
            "patterns": _patterns(Draw(np.random.default_rng(0), 1), 1),
            "ids": np.zeros(3, int),
        },
    ),
    contract=f"patterns, ids: N, rng -> {FOUR}",
    # A permutation may be drawn as its samples are asked for.
    columns=False,
    features=_ways,
)
