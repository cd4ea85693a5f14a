"""Laws about samples that numbers u decide: small steps of u are small steps, and even numbers give even samples."""

from collections.abc import Callable
from typing import Any

import numpy as np

from course.engine.core.types import Words
from course.engine.terms.samplers.sobol import net_indices, owen_scrambled, shuffled, sobol_words
from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import Arguments, Case, Function, Law
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import where
from course.school.grading.checks.laws import exact, first_result

COUNTS = (16, 64, 256, 1024)

REPEATS = 32

LEAST_ORDER = 0.65
"""Of the error of a mean over evenly placed points; independent ones have 0.5."""


def smooth(limit: float, *, case: Case | None = None) -> Law:
    """A small step of u is a small step of the point: angles in degrees make a step 57 times as long.

    ``limit``: of the way that a point goes, over the step of u that makes it, for most u
    """
    step = 2.0**-12

    def run(function: Function, trial: Trial) -> None:
        a = function.make(Draw(trial.rng, 600, np.float64), case)
        a["u"] = numbers = a.u * (1 - 2 * step)
        rows = range(numbers.shape[0] if numbers.ndim == 2 else 1)
        first = np.asarray(first_result(function.call(trial, a)))
        for row in rows:
            moved = numbers.copy()
            (moved[row] if numbers.ndim == 2 else moved)[...] += step
            a["u"] = moved
            way = np.abs(np.asarray(first_result(function.call(trial, a))) - first)
            far = (np.linalg.norm(way, axis=0) if way.ndim == 2 else way) / step
            # Where a warp has a seam some points jump; half of them never do.
            typical = float(np.median(far))
            if not typical <= limit:
                k = int(np.argsort(far)[far.size // 2])
                raise Failure(
                    f"a small step of u to move a point at most {limit:g} times as far",
                    f"{typical:.4g} times as far for most points",
                    f"{where(a, (k,), (numbers.shape[-1],))}, and {step:.2g} less in row {row}",
                    "Are all angles in radians, and used once?",
                )

    return Law("smooth", "A small step of u is a small step of the point", run, case=case)


def evenly(
    value: Callable[[Arguments, Any], Array], exact_mean: float, *, case: Case | None = None
) -> Law:
    """Evenly placed numbers give evenly placed points: with Sobol's the error of a mean falls faster than with N^-0.5.

    ``value``: (N,) smooth values, whose mean is ``exact_mean``
    """

    def run(function: Function, trial: Trial) -> None:
        errors, off = [], []
        for number_of in COUNTS:
            word = function.argument("u").sizes[0]
            rows = int(word) if word.isdigit() else 1
            numbers = _sobol(trial.rng, number_of, rows)
            a = function.make(Draw(trial.rng, numbers.shape[1], np.float32), case)
            a["u"] = numbers if word.isdigit() else numbers[0]
            found = np.asarray(value(exact(a), function.call(trial, a)))
            off.append(found.reshape(REPEATS, number_of).mean(axis=1) - exact_mean)
            errors.append(float(np.sqrt((off[-1] ** 2).mean())))
        _check_centred(off, exact_mean)
        check_order(errors, LEAST_ORDER)

    title = "Evenly placed numbers give evenly placed points"
    chance = 1e-7 + SKEWED_BY_CHANCE
    return Law("order", title, run, kind="order", false_fail=chance, case=case)


SKEWED, SKEWED_BY_CHANCE = 9.0, 1e-9
"""Standard errors, and how often Student's t of 31 degrees of freedom is beyond them."""

ROUNDED = 4e-6
"""Of single precision, in a mean of numbers around 1."""


def _check_centred(off: list[Array], exact_mean: float) -> None:
    """Means over sets that are scrambled independently, of the largest size, are right on average: a t-test."""
    skews, bounds = np.array([_skew(errors) for errors in off]).T
    if not abs(skews[-1]) <= bounds[-1]:
        first = int((~(np.abs(skews) <= bounds)).argmax())
        failure = Failure(
            f"a mean of {exact_mean:.6g} within {bounds[-1]:.1g}",
            f"{exact_mean + skews[-1]:.6g}",
            f"{REPEATS} sets of {COUNTS[-1]} evenly placed points",
            "The mean is off, whatever the number of points: somewhere there are too many, or none.",
        )
        failure.example = (
            f"{REPEATS} sets of {COUNTS[first]} evenly placed points: a mean of {exact_mean:.4g} expected, "
            f"{exact_mean + skews[first]:.4g} came"
        )
        raise failure


def _skew(errors: Array) -> tuple[float, float]:
    """How far means are off on average, and how far they may be."""
    bound = SKEWED * float(errors.std(ddof=1)) / np.sqrt(errors.size) + ROUNDED
    return float(errors.mean()), bound


def check_order(errors: list[float], least: float, hint: str = "") -> None:
    """Errors at ``COUNTS`` fall with that order at the least. Raises Failure."""
    order = fitted(errors)
    if order >= least:
        return
    if min(errors) > 0.3 * max(errors):
        hint = hint or "The mean itself is off, whatever the number of points: that comes first."
    hint = hint or "Neighbouring u should go to neighbouring points, and only u may decide where."
    pairs = zip(COUNTS, errors, strict=True)
    failure = Failure(
        f"the error of a mean to fall with N^-{least} or faster",
        f"N^-{order:.2f}",
        ", ".join(f"{error:.2g} at N = {number_of}" for number_of, error in pairs),
        hint,
    )
    for k in range(len(errors) - 1):
        goal = errors[k] * (COUNTS[k] / COUNTS[k + 1]) ** least
        if errors[k + 1] > goal:
            failure.example = (
                f"from N = {COUNTS[k]} to {COUNTS[k + 1]} the error goes from {errors[k]:.2g} to "
                f"{errors[k + 1]:.2g}; {goal:.2g} or less was expected"
            )
            break
    raise failure


def fitted(errors: list[float]) -> float:
    """The order with which errors at ``COUNTS`` fall."""
    # Float32 sums end near 1e-7; an error there is no error.
    return float(-np.polyfit(np.log(COUNTS), np.log(np.maximum(errors, 1e-7)), 1)[0])


def _sobol(rng: np.random.Generator, number_of: int, rows: int) -> Array:
    """(rows, REPEATS * number_of): so many numbers after each other, each time scrambled anew."""
    index = shuffled(np.arange(number_of, dtype=np.uint32), np.zeros(1, np.uint32))[0]
    words: Words = np.concatenate([sobol_words(index), sobol_words(net_indices(index))])[
        :rows, None
    ]
    seeds = rng.integers(1 << 32, size=(rows, REPEATS, 1), dtype=np.uint32)
    found: Array = (owen_scrambled(words, seeds) >> np.uint32(8)) * np.float32(2.0**-24)
    return found.reshape(rows, -1)
