"""What comes back from a function is taken apart without trust, and what is wrong with it is told."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from course.grading.checks.check import Failure
from course.grading.checks.contract import (
    check_seeded,
    contract_checks,
    finite_floats,
    finite_numbers,
    near,
    pair,
)
from tests.grading.checks.by_hand import trial_of


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_floats_of_any_precision_come_as_float64(dtype: Any) -> None:
    given = np.array([[0.5, -2.0, 3.0]], dtype)
    for found in (finite_floats(given, (1, 3)), finite_numbers(given, (1, 3))):
        assert found.dtype == np.float64
        assert found.tolist() == [[0.5, -2.0, 3.0]]


@pytest.mark.parametrize("dtype", [np.int32, np.uint8])
def test_whole_numbers_are_numbers_but_no_floats(dtype: Any) -> None:
    given = np.array([1, 2], dtype)
    assert finite_numbers(given, (2,)).tolist() == [1.0, 2.0]
    with pytest.raises(Failure, match=rf"the points to be floating, found dtype {given.dtype}"):
        finite_floats(given, (2,), "the points")


@pytest.mark.parametrize("check", [finite_floats, finite_numbers])
@pytest.mark.parametrize(
    ("value", "told"),
    [
        (None, "to be an ndarray, found NoneType"),
        ([1.0, 2.0], "to be an ndarray, found list"),
        (np.float32(1), "to be an ndarray, found float32"),
        (np.zeros(3), r"of shape \(2,\), found shape \(3,\)"),
        (np.zeros((2, 1)), r"of shape \(2,\), found shape \(2, 1\)"),
        (np.array([True, False]), "to be floating, found dtype bool"),
        (np.array([1j, 2]), "to be floating, found dtype complex128"),
        (np.array(["1", "2"]), "to be floating, found dtype <U1"),
        (np.array([None, 1.0]), "to be floating, found dtype object"),
        (np.array([1.0, np.nan]), r"to be finite, found nan \(at index \(1,\)\)"),
        (np.array([-np.inf, 1.0]), r"to be finite, found -inf \(at index \(0,\)\)"),
    ],
)
def test_what_is_no_array_of_numbers_is_refused(check: Any, value: Any, told: str) -> None:
    with pytest.raises(Failure, match=f"expected its colours {told}"):
        check(value, (2,), "its colours")


def test_a_subclass_of_ndarray_is_refused() -> None:
    class Masked(np.ndarray):
        pass

    with pytest.raises(Failure, match="to be an ndarray, found Masked"):
        finite_floats(np.zeros(1).view(Masked), (1,))


@pytest.mark.parametrize("value", [(1, "two"), [1, "two"]])
def test_a_pair_is_a_tuple_or_a_list(value: Any) -> None:
    assert pair(value, "mean", "variance") == (1, "two")


@pytest.mark.parametrize("value", [None, (1,), (1, 2, 3), np.zeros(2), {1: 2, 3: 4}, "ab"])
def test_what_is_no_pair_is_refused_by_name(value: Any) -> None:
    with pytest.raises(Failure, match="two results: mean, variance"):
        pair(value, "mean", "variance")


def test_near_means_every_number() -> None:
    assert near(np.array([1.0, 2.0]), np.array([1.0005, 2.0]))
    assert not near(np.array([1.0, 2.0]), np.array([1.0, 2.002]))
    assert not near(np.array([1.0, 2.0]), np.array([1.0005, 2.0]), 1e-4)
    assert not near(np.array([np.nan, 2.0]), 2.0)
    # Of unsigned numbers the difference would be far from nothing.
    assert near(np.array([1], np.uint8), np.array([1.0004]))


def test_the_checks_of_a_contract() -> None:
    runs = [lambda _trial, k=k: k for k in range(3)]
    checks = contract_checks("lens_rays", *runs)
    assert [(check.function, check.name, check.kind, check.points) for check in checks] == [
        ("lens_rays", name, "contract", 1.0) for name in ("contract", "untouched", "refuses")
    ]
    assert [check.run for check in checks] == runs


def test_the_generator_decides() -> None:
    check_seeded(trial_of(), lambda rng: rng.random(5))
    with pytest.raises(Failure, match="other points from a generator with another seed"):
        check_seeded(trial_of(), lambda _rng: np.arange(5.0))
    own = np.random.default_rng(1)
    with pytest.raises(Failure, match="the same samples from generators with the same seed"):
        check_seeded(trial_of(), lambda _rng: own.random(5), "samples")


def test_numbers_for_calls() -> None:
    trial = trial_of()
    u = trial.uniform(3, 1000)
    assert u.shape == (3, 1000)
    assert u.dtype == np.float32
    assert u.min() >= 0
    assert u.max() < 1
    assert trial.uniform(2, 1, np.float64).dtype == np.float64
    # Whatever one call does with its generator, another's is its own, and both are the seed's.
    first, second = trial.generator().random(4), trial.generator().random(4)
    assert not np.isin(first, second).any()
    again = trial_of()
    again.uniform(3, 1000)
    again.uniform(2, 1, np.float64)
    assert np.array_equal(again.generator().random(4), first)
