"""Motion blur: times while the shutter is open, however short that is."""

import math

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, unit, worst_units

shutter_times = SOLUTIONS.function("motion_blur", "shutter_times")


dtypes = pytest.mark.parametrize("dtype", DTYPES)

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
    (0.1, 0.1),
    (-3.7, -3.7),
]


@dtypes
@pytest.mark.parametrize(("start", "end"), INTERVALS)
def test_times_lie_in_the_half_open_interval_after_rounding_too(
    dtype: type, start: float, end: float
) -> None:
    u = np.sort(np.concatenate((worst_units(1, dtype)[0], unit(1, 1000, dtype)[0])))
    times = shutter_times(start, end, u)
    assert times.dtype == dtype
    first, last = dtype(start), dtype(end)
    assert (times >= first).all()
    assert times[0] == first
    # Where the dtype has no number between them, the interval is the one time that both are rounded to.
    assert (times < last).all() if first < last else (times == first).all()
    assert (np.diff(times) >= 0).all()
