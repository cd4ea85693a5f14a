"""The forms that laws come in: each passes what is right, fails what is a little wrong, and shows a small input."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course.school.grading.checks.check import Failure
from course.school.grading.checks.declare import Function, Law, function
from course.school.grading.checks.distributions import means, uniform
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.laws import close, holds, unit_length, within
from tests.school.grading.checks.declaring import SHIFTED, but, shifted, trial


def declared(law: Law) -> Function:
    """A function that returns numbers as it got them."""
    return function("tests.same", {}, (law,), contract="u: 2 N -> the numbers: 2 N")


def run(law: Law, function: Callable[..., Any], seed: int = 0) -> None:
    for each in filter(None, (law, law.beside)):
        each.run(declared(each), trial(function, "same", seed))


SAME: dict[str, tuple[Law, Callable[[Any], Any]]] = {
    "close": (close("it", "", lambda a, r: (r, a.u)), lambda u: u + u.dtype.type(1e-5)),
    "close to infinity": (
        close("it", "", lambda a, r: (np.where(r == a.u, np.inf, r), np.inf)),
        lambda u: u + u.dtype.type(1e-3),
    ),
    "holds": (holds("it", "", lambda a, r: r[0] == a.u[0], "equal"), lambda u: u[::-1]),
    "within": (within("it", "", lambda _, r: r[0], 0, 1), lambda u: 1.01 * u),
    "uniform": (uniform("it", "", lambda _, r: r, (16, 16)), lambda u: u**1.05),
    "uniform together": (
        uniform("it", "", lambda _, r: r, (16, 16)),
        lambda u: np.stack((u[0], (u[0] + 0.1 * u[1]) % 1)),
    ),
    "uniform but for its ends": (
        uniform("it", "", lambda _, r: r, (16, 16)),
        lambda u: np.clip(u, 0.005, 1).astype(u.dtype),
    ),
    "evenly, a little off": (
        evenly(lambda _, r: r[0] * r[1], 0.25),
        lambda u: u ** u.dtype.type(1.002),
    ),
    "uniform by other numbers": (
        uniform("it", "", lambda _, r: r, (16, 16)),
        lambda u: np.random.default_rng().random(u.shape, np.float32).astype(u.dtype),
    ),
    "means": (
        means("it", "", lambda _, r: [("mean", r[0], 0.5, 1 / 12)], comparisons=1),
        lambda u: u + u.dtype.type(0.02),
    ),
    "smooth": (smooth(3.0), lambda u: (57.3 * u) % 1),
    "evenly": (
        evenly(lambda _, r: r[0] * r[1], 0.25),
        lambda u: np.random.default_rng(0).random(u.shape, np.float32),
    ),
}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", SAME)
def test_a_law_passes_the_right_and_fails_the_nearly_right(name: str) -> None:
    law, wrong = SAME[name]
    for seed in range(3):
        run(law, lambda u: u.copy(), seed)
        with pytest.raises(Failure) as caught:
            run(law, wrong, seed)
        assert caught.value.example or caught.value.where


def test_no_number_is_no_right_number() -> None:
    law = close("it", "", lambda a, r: (np.where(r > 0.5, np.nan, r), a.u))
    with pytest.raises(Failure, match="found nan"):
        run(law, lambda u: u)


def test_unit_length_is_asked_to_1e_5() -> None:
    law = unit_length(lambda a, r: (r - a.center[:, None]) / a.radius)
    law.run(SHIFTED, trial(shifted))
    with pytest.raises(Failure, match="a length of 1"):
        law.run(SHIFTED, trial(but(lambda v, a: v + 3e-5 * a.radius * a.direction)))


def test_a_failure_shows_the_smallest_input_in_round_numbers() -> None:
    (law,) = SHIFTED.laws
    with pytest.raises(Failure) as caught:
        law.run(SHIFTED, trial(but(lambda value, a: value - a.center[:, None])))
    told = caught.value
    assert "center = (" in told.where
    assert told.example.startswith("shifted(center = [")
    assert ": expected " in told.example
    inside = told.example.partition("direction = ")[2].partition("radius")[0]
    assert inside.count(",") <= 6  # three columns at most
    assert told.hint == "From the centre, not from the origin."


def test_a_mistake_in_a_corner_shows_the_worst_column_where_no_small_input_does() -> None:
    (law,) = SHIFTED.laws
    with pytest.raises(Failure) as caught:
        law.run(SHIFTED, trial(but(lambda value, _: value * (1 + (value.shape[1] > 100)))))
    assert caught.value.example == caught.value.where


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_rounding_is_judged_by_the_size_of_the_values(scale: float) -> None:
    law = close(
        "it", "", lambda a, r: (r, a.center[:, None] + a.radius * a.direction), scales=(scale,)
    )
    law.run(SHIFTED, trial(shifted))
    with pytest.raises(Failure):
        law.run(SHIFTED, trial(but(lambda value, _: value * (1 + 1e-4))))
