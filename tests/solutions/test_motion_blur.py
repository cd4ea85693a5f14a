"""Motion blur: times while the shutter is open, and rays as a moving object sees them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
    directions,
    frozen,
    unit,
    worst_units,
)

shutter_times = SOLUTIONS.function("motion_blur", "shutter_times")
displacement = SOLUTIONS.function("motion_blur", "displacement")
to_object_space = SOLUTIONS.function("motion_blur", "to_object_space")

VELOCITY = np.array((0.5, -2.0, 1 / 3))

dtypes = pytest.mark.parametrize("dtype", DTYPES)


# ---------------------------------------------------------------- shutter times

INTERVALS = [
    (0.0, 1.0),
    (-0.5, 0.5),
    (0.1, 0.3),
    (-7.0, -6.99),
    (1e6, 1e6 + 1e-3),
    (1e6, 1e6 + 0.2),
    (-1e6 - 1e-3, -1e6),
    (999999.0, 999999.0625),
    (0.0, 1e-6),
    (-1e-6, 1e-6),
    (1.0, math.nextafter(1.0, 2.0)),
    (-1e6, 1e6),
]


@dtypes
@pytest.mark.parametrize(("start", "end"), INTERVALS)
def test_times_lie_in_the_half_open_interval_after_rounding_too(
    dtype: type, start: float, end: float
) -> None:
    u = np.sort(np.concatenate((worst_units(1, dtype)[0], unit(1, 1000, dtype)[0], [dtype(1)])))
    times = shutter_times(start, end, u)
    assert times.dtype == dtype
    first, last = dtype(start), dtype(end)
    assert (times >= first).all()
    assert times[0] == first
    # Where the dtype has no number between them, the interval is the one time that both are rounded to.
    assert (times < last).all() if first < last else (times == first).all()
    assert (np.diff(times) >= 0).all()


@dtypes
@pytest.mark.parametrize("time", [0, 0.0, -0.0, 0.1, -3.7, 1e-6, 1e6, -1e6])
def test_a_shutter_that_closes_as_it_opens_gives_exactly_that_time(
    dtype: type, time: float
) -> None:
    for u in (worst_units(1, dtype)[0], unit(1, 1000, dtype)[0]):
        assert (shutter_times(time, time, u) == dtype(time)).all()


@pytest.mark.parametrize(
    ("start", "end"),
    [(1.0, 0.0), (0.0, -1e-45), (math.nan, 1.0), (0.0, math.nan), (0.0, math.inf)],
)
def test_a_shutter_that_closes_before_it_opens_is_refused(start: float, end: float) -> None:
    message = f"^open and close must be finite and open <= close, got {start} and {end}$"
    with pytest.raises(ValueError, match=message):
        shutter_times(start, end, unit(1, 5)[0])


# ---------------------------------------------------------------- moving


@dtypes
def test_displacement_is_velocity_times_time(dtype: type) -> None:
    time = unit(1, 1000, dtype, seed=2)[0] * dtype(8) - dtype(4)
    gone = displacement(VELOCITY, time)
    exact = VELOCITY[:, None] * time.astype(float)
    assert np.abs(gone - exact).max() <= 8 * np.finfo(dtype).eps
    assert (displacement(VELOCITY, np.zeros(5, dtype)) == 0).all()
    at_one = displacement(VELOCITY, np.ones(5, dtype))
    assert (at_one == VELOCITY.astype(dtype)[:, None]).all()


@pytest.mark.parametrize("o_dtype", DTYPES)
@pytest.mark.parametrize("t_dtype", DTYPES)
@pytest.mark.parametrize("zero", [np.zeros(3), np.array([0, -0.0, 0]), np.zeros(3, np.float32)])
def test_what_stands_still_sees_the_origins(o_dtype: type, t_dtype: type, zero: Array) -> None:
    origins = np.concatenate(
        (directions(1000, o_dtype, 3), np.array([[0, -0.0, 1e-6], [1e6, -1e6, 1], [3, 2, 1]]).T),
        axis=1,
    ).astype(o_dtype)
    time = unit(1, origins.shape[1], t_dtype, seed=4)[0] * t_dtype(1e6) - t_dtype(5e5)
    locked = frozen(origins)
    seen = to_object_space(locked, zero, time)
    expected = origins.astype(seen.dtype)
    np.testing.assert_array_max_ulp(seen, expected, 4)
    assert not np.shares_memory(seen, locked)
    # And at time 0 so does everything.
    at_first = to_object_space(origins, VELOCITY, np.zeros_like(time))
    np.testing.assert_array_max_ulp(at_first, expected, 4)


@pytest.mark.parametrize("o_dtype", DTYPES)
@pytest.mark.parametrize("t_dtype", DTYPES)
def test_a_ray_meets_the_object_at_rest_where_it_meets_the_moving_one(
    o_dtype: type, t_dtype: type
) -> None:
    """Rays at points of a moving ball: where they would be at their own time, and in the ball's space."""
    n = 1000
    on_ball = directions(n, float, 5)
    time = unit(1, n, t_dtype, seed=6)[0]
    moved = on_ball + VELOCITY[:, None] * time
    toward = directions(n, float, 7)
    origins = (moved - 3 * toward).astype(o_dtype)
    seen = to_object_space(origins, VELOCITY, time)
    rounding = 16 * np.finfo(np.result_type(o_dtype)).eps
    assert np.abs(np.linalg.norm(seen + 3 * toward, axis=0) - 1).max() <= rounding
    assert np.abs(seen + 3 * toward - on_ball).max() <= rounding
