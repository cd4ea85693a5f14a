"""A mistake is told by the known submission that behaves alike, and by nothing else."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course.school.grading.checks.declare import function
from course.school.grading.checks.mistakes import Print, matching, probes, taken
from course.school.grading.checks.trusted import TrustedModule

DISK = function(
    "tests.disk",
    {},
    (),
    contract="u: 2 N -> the points: 2 N",
    free=True,
    features=lambda _, r: np.stack((np.hypot(*r), np.arctan2(r[1], r[0]) / (2 * np.pi) % 1)),
)

Warp = Callable[[Any], Any]


def _polar(radius: Warp, turns: float = 1.0) -> Warp:
    def warp(u: Any) -> Any:
        r, phi = radius(u[0]), 2 * np.pi * turns * u[1]
        return np.stack((r * np.cos(phi), r * np.sin(phi))).astype(u.dtype)

    return warp


RIGHT = _polar(np.sqrt)
WRONG = {
    "crowded": _polar(lambda x: x),
    "half": _polar(np.sqrt, 0.5),
    "double": lambda u: RIGHT(u).astype(np.float64),
    "writes": lambda u: np.multiply(RIGHT(u), 1, out=u),
    "raises": lambda u: RIGHT(u) if u.shape[1] > 100 else np.dot(u, u),
}


def _print(warp: Warp) -> Print:
    return taken(DISK, TrustedModule({"disk": warp}), probes(DISK))


def _named(warp: Warp) -> str:
    wrong = [(name, _print(made)) for name, made in WRONG.items()]
    return matching(DISK, TrustedModule({"disk": warp}), wrong, _print(RIGHT))


@pytest.mark.parametrize("name", WRONG)
def test_who_makes_a_known_mistake_is_told_so(name: str) -> None:
    assert _named(WRONG[name]) == name


@pytest.mark.parametrize("name", ["crowded", "half"])
@pytest.mark.parametrize(
    "turn",
    [
        lambda u: u[::-1],
        lambda u: np.clip(1 - u, 0, np.nextafter(u.dtype.type(1), u.dtype.type(0))),
        lambda u: np.stack((u[1], np.clip(1 - u[0], 0, 1 - 2.0**-24).astype(u.dtype))),
    ],
    ids=["rows exchanged", "mirrored", "both"],
)
def test_rows_and_senses_of_u_are_free(name: str, turn: Warp) -> None:
    assert _named(lambda u: WRONG[name](turn(u))) == name


def test_numbers_may_be_used_in_any_other_way() -> None:
    # Both numbers folded and shifted: no order and no sense of u gives the known submission's places.
    assert (
        _named(lambda u: WRONG["crowded"]((u * u.dtype.type(3) + u.dtype.type(0.2)) % 1))
        == "crowded"
    )


@pytest.mark.parametrize(
    "warp",
    [
        RIGHT,
        lambda u: RIGHT((u + u.dtype.type(0.3)) % 1),
        lambda u: RIGHT(u) * u.dtype.type(0.9),
        _polar(lambda x: x**2),
        np.zeros_like,
        lambda u: np.full_like(u, np.nan),
        lambda _: None,
        lambda u: u.tolist(),
        lambda u: (u, u),
    ],
)
def test_nobody_else_is_told_so(warp: Warp) -> None:
    assert _named(warp) == ""
