"""The benchmark of `--error`: what counts as near, and that errors of references are taken off."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from benchmarks.reached_error import CASES, QUICK, Effort, Runs, error_of, figures, near
from course.benchmarking.references import Reference


def test_300_runs_over_30_scenes() -> None:
    assert len(CASES) == 30
    assert Effort().seeds * len(Effort().names) == 300
    assert set(QUICK.names) <= set(CASES)
    assert all(path.is_file() for path, _ in CASES.values())


def test_runs_are_near_on_both_sides() -> None:
    runs = Runs("x", 2.0, (2.0,) * 4, (1.7, 1.9, 2.1, 2.3), (8.0,) * 4, bounded=True)
    assert near([runs]) == 0.5
    assert runs.apart == pytest.approx([2 / 1.7, 2 / 1.9, 1.05, 1.15])
    share, one = figures([runs])
    assert (share.value, share.reached) == (0.5, False)
    assert one.high == pytest.approx(2 / 1.7)


def test_the_error_of_a_reference_is_taken_off_in_squares() -> None:
    rng = np.random.default_rng(1)
    noise, own = 0.3 * rng.standard_normal((2, 100, 100, 3))
    ideal = Reference((0.5 * own).astype(np.float32), 0.15, 64, "")
    picture: Any = SimpleNamespace(linear=noise.astype(np.float32))
    # 30,000 numbers: 0.4% of an error, of which 6 are chance less than once in 1e8.
    assert error_of(picture, ideal) == pytest.approx(0.3, rel=0.03)
