"""The smallest sample that shows that a distribution is wrong: the fewest points, and where too many or too few lie."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations, product

import numpy as np

from course.grading.checks.check import Array
from course.grading.checks.statistics import SIGMAS


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
