"""How wrong a known submission is, by what it gives and not by the checks that it fails.

It is called with ordinary arguments, and its results are compared with the reference's: column by column, or, where
the numbers u may be used in any way, by the distribution of features. Where many results are right, as of a function
that builds a tree, nothing is said.
"""

from copy import deepcopy
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Caller, Failure
from course.school.grading.checks.declare import Arguments, Function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import exact
from course.school.grading.errors import StudentError

COLUMNS = 2000

NEAR = 0.01
"""Of the typical value: so near counts as right."""

USELESS, CORNER = 0.5, 0.05
"""Shares of wrong columns from which a function is of no use, and up to which it is wrong in a corner only."""

BROAD = 0.2
"""Distance of two distributions (Kolmogorov and Smirnov) from which a function is of no use."""


def is_useless(function: Function, wrong: Caller, right: Caller) -> bool:
    """Whether most of what it gives is wrong."""
    return function.unique and _share(function, wrong, right) >= USELESS


def is_right_elsewhere(function: Function, wrong: Caller, right: Caller) -> bool:
    """Whether hardly anything of what it gives for ordinary arguments is wrong."""
    return function.unique and _share(function, wrong, right) <= CORNER


def _share(function: Function, wrong: Caller, right: Caller) -> float:
    """The share of columns that are wrong; of a distribution, its distance as a multiple of what is broad."""
    found: list[float] = []
    for seed in range(4):
        a = function.make(Draw(np.random.default_rng(seed), COLUMNS, np.float32))
        values = [_values(function, caller, a) for caller in (wrong, right)]
        if values[0] is None or values[1] is None:
            return 1.0
        if function.features is not None:
            distance = _distance(function, a, values)
            found.append(min(distance / BROAD * USELESS, 1.0))
        else:
            found.append(_columns(*map(_parts, values)))
    return float(np.mean(found))


def _values(function: Function, caller: Caller, a: Arguments) -> Any:
    given = deepcopy(list(a.values()))
    try:
        with np.errstate(all="ignore"):
            value = caller.call(function.name, *given)
            return function.seen(value, a)
    except (StudentError, Failure):
        return None


def _parts(value: Any) -> list[Array]:
    return [
        np.asarray(part, np.float64) for part in (value if isinstance(value, tuple) else (value,))
    ]


def _columns(wrong: list[Array], right: list[Array]) -> float:
    shares = []
    for ours, theirs in zip(wrong, right, strict=True):
        if ours.shape != theirs.shape:
            return 1.0
        finite = np.abs(theirs[np.isfinite(theirs)])
        typical = float(np.median(finite)) if finite.size else 1.0
        # Codes and numbers of things are right or wrong.
        part = 0.0 if (finite == np.floor(finite)).all() else NEAR
        with np.errstate(invalid="ignore"):
            near = np.abs(ours - theirs) <= part * np.maximum(np.abs(theirs), typical)
        # Beside infinity everything would be near.
        off = ~(np.where(np.isfinite(theirs), near, False) | (ours == theirs))
        off = off.reshape(-1, off.shape[-1]).any(axis=0) if off.ndim else off.reshape(1)
        shares.append(float(off.mean()))
    return max(shares)


def _distance(function: Function, a: Arguments, values: list[Any]) -> float:
    assert function.features is not None
    with np.errstate(all="ignore"):
        ours, theirs = (np.asarray(function.features(exact(a), value)) for value in values)
    distances = [0.0]
    for one, other in zip(ours, theirs, strict=True):
        both = np.concatenate((one, other))
        below = [np.searchsorted(np.sort(row), both, "right") / row.size for row in (one, other)]
        distances.append(float(np.abs(below[0] - below[1]).max()))
    return max(distances)
