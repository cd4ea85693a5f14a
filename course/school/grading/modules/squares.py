"""Directions that are jittered in a square: what stays the same however the square is turned or mirrored."""

from math import nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Case, Law
from course.school.grading.checks.laws import close
from course.school.grading.checks.vectors import dot


def offsets(a: Arguments, r: Array) -> Array:
    """From the directions' tips to where the jittered ones meet the planes at right angles there; NaN for none."""
    ahead = dot(r, a.direction)
    return np.asarray(r / np.where(ahead > 0, ahead, nan) - a.direction)


def _products(a: Arguments, r: Array) -> tuple[Any, ...]:
    """All dot products of one direction's offsets, and those of the places in the square."""
    found, places = offsets(a, r), a.roughness * (a.u - 0.5)
    return found.T @ found, places.T @ places, a.roughness * (1 + a.roughness)


def square(name: str, title: str, hint: str = "", **how: Any) -> Law:
    """The offsets fill the square; the case is the same direction in all columns."""
    return close(
        name,
        title,
        _products,
        hint or "The direction is the square's middle, roughness the length of both sides.",
        what="between the offsets of two jittered directions a dot product of",
        within=40,
        n=300,
        **how,
    )


def no_jitter(size: str, case: Case | None = None) -> Law:
    """Without a size the direction stays."""
    return close(
        "no_jitter",
        f"{size.capitalize()} 0 gives the direction",
        lambda a, r: (r, a.direction, 1.0),
        f"With {size} 0 there is nothing to be added to the direction.",
        what=f"with {size} 0, the direction itself:",
        within=4,
        case=lambda draw: {**(case(draw) if case else {}), size: 0.0},
    )
