"""The benchmark of told errors: which runs are near, and that the worst run decides whether a bound holds."""

import pytest

from benchmarks.reached_error import Runs
from benchmarks.told_errors import figures, near

TRUE = Runs("true", 1.0, (1.0, 0.95, 1.05), (1.0, 1.0, 1.0), (8.0,) * 3, bounded=True)
LOST = Runs("lost", 1.0, (1.0, 1.0, 0.8), (1.0, 1.2, 3.5), (8.0,) * 3, bounded=True)
CAUSE = Runs("cause", 1.0, (1.0,), (9.0,), (8.0,), bounded=False)


def test_runs_are_near_whose_told_error_is_within_a_tenth() -> None:
    assert near([TRUE]) == 1
    assert near([TRUE, LOST]) == pytest.approx(4 / 6)


def test_one_run_in_one_scene_misses_the_bound_but_where_a_cause_is_told() -> None:
    share, most = figures([TRUE, TRUE, LOST, CAUSE])
    assert share.value == pytest.approx(7 / 10)
    assert (most.value, most.reached) == (3.5, False)
    assert figures([TRUE, CAUSE])[1].reached
