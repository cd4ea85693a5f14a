"""A function that is declared and written in a test: points at a distance from their centre."""

from collections.abc import Callable
from math import nan
from typing import Any

import numpy as np

from course.school.grading.checks.check import Trial
from course.school.grading.checks.declare import Arguments, directions, function, length
from course.school.grading.checks.laws import close
from course.school.grading.checks.trusted import TrustedModule

SHIFTED = function(
    "tests.shifted",
    {"direction": directions(), "radius": length(0.5, 5, (-1.0, nan))},
    (
        close(
            "values",
            "Points lie that far from the centre, each in its direction",
            lambda a, r: (r, a.center[:, None] + a.radius * a.direction),
            "From the centre, not from the origin.",
        ),
    ),
    contract="center: 3, direction: 3 N, radius -> the points: 3 N",
)


def shifted(center: Any, direction: Any, radius: Any) -> Any:
    """A right one, in the most natural form."""
    if np.shape(center) != (3,):
        raise ValueError(f"center must have shape (3,), got {np.shape(center)}")
    if np.ndim(direction) != 2 or len(direction) != 3:
        raise ValueError(f"direction must have shape (3, N), got {np.shape(direction)}")
    if not radius >= 0:
        raise ValueError(f"radius must be >= 0, got {radius}")
    return (center[:, None] + radius * direction).astype(direction.dtype)


def but(change: Callable[..., Any]) -> Callable[..., Any]:
    """The right one with another value: ``change`` takes it and the arguments."""

    def function(center: Any, direction: Any, radius: Any) -> Any:
        return change(
            shifted(center, direction, radius),
            Arguments(center=center, direction=direction, radius=radius),
        )

    return function


def trial(function: Callable[..., Any], name: str = "shifted", seed: int = 0) -> Trial:
    """Of a function of this process."""
    return Trial(name, TrustedModule({name: function}), np.random.default_rng(seed))
