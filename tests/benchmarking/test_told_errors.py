"""The benchmark of told errors: which runs are near, and that the worst run decides whether a bound holds."""

import pytest

from benchmarks.reached_error import Runs
from benchmarks.told_errors import figures, near, spread

TRUE = Runs("true", 1.0, (1.0, 0.95, 1.05), (1.0, 1.0, 1.0), (8.0,) * 3, bounded=True)
LOST = Runs("lost", 1.0, (1.0, 1.0, 0.8), (1.0, 1.2, 3.5), (8.0,) * 3, bounded=True)
CAUSE = Runs("cause", 1.0, (1.0,) * 2, (9.0, 12.0), (8.0,) * 2, bounded=False)


def test_runs_are_near_whose_told_error_is_within_a_tenth() -> None:
    assert near([TRUE]) == 1
    assert near([TRUE, LOST]) == pytest.approx(4 / 6)


def test_one_run_in_one_scene_misses_the_bound_but_where_a_cause_is_told() -> None:
    share, steady, most = figures([TRUE, TRUE, LOST, CAUSE])
    assert share.value == pytest.approx(7 / 11)
    assert (most.value, most.reached) == (3.5, False)
    assert steady.value == 1
    assert figures([TRUE, CAUSE])[-1].reached


def test_scenes_whose_error_is_chance_are_counted_apart() -> None:
    """Of 0.95, 1 and 1.05 the standard deviation is 0.05; of 0.9, 1 and 1.1 it is 0.1."""
    steady, chance = (
        Runs("", 1.0, (1.0,) * 3, (1 - d, 1.0, 1 + d), (8.0,) * 3, bounded=True)
        for d in (0.0499, 0.12)
    )
    assert (spread(steady), spread(chance)) == pytest.approx((0.0499, 0.12))
    share, alone, _ = figures([steady, chance])
    assert (share.value, alone.value) == (pytest.approx(4 / 6), 1)
    assert "1 of 2 scenes" in alone.name
