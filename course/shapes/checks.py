"""What the shapes ask of their parameters; a check names the parameter, its value, its range."""

from __future__ import annotations

import math
import operator
from typing import SupportsFloat, SupportsIndex

# Between these bounds a length, its square and its reciprocal all fit a float64.
SHORTEST = 1e-150
LONGEST = 1e150


def finite(name: str, value: SupportsFloat) -> float:
    """Return `value` as a float; ValueError if it is infinite or not a number."""
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{name} is {number}: expected a finite number")
    return number


def length(name: str, value: SupportsFloat) -> float:
    """Return a length [m] > 0; ValueError if it isn't one, or beyond what float64 can square."""
    number = finite(name, value)
    if number <= 0.0:
        raise ValueError(f"{name} is {number:g}: expected a number > 0")
    if not SHORTEST <= number <= LONGEST:
        raise ValueError(f"{name} is {number:g}: expected {SHORTEST:g} to {LONGEST:g}")
    return number


def at_least_zero(name: str, value: SupportsFloat, most: float = LONGEST) -> float:
    """Return a number in [0, most]; ValueError otherwise."""
    number = finite(name, value)
    if not 0.0 <= number <= most:
        raise ValueError(f"{name} is {number:g}: expected 0 to {most:g}")
    return number


def count(name: str, value: SupportsIndex, least: int, most: int) -> int:
    """Return an integer in [least, most]; ValueError otherwise, a fraction or a truth value too."""
    try:
        number = operator.index(value)
    except TypeError:
        raise ValueError(f"{name} is {value!r}: expected a whole number") from None
    if isinstance(value, bool) or not least <= number <= most:
        raise ValueError(f"{name} is {value!r}: expected a whole number, {least} to {most}")
    return number
