"""Path tracing: Russian roulette of hardly any light."""

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS

russian_roulette = SOLUTIONS.function("path_tracing", "russian_roulette")


dtypes = pytest.mark.parametrize("dtype", DTYPES)


@dtypes
def test_the_smallest_throughput_is_carried_or_ended(dtype: type) -> None:
    tiny = np.finfo(dtype).smallest_subnormal
    with np.errstate(all="raise"):
        survives, after = russian_roulette(np.full((3, 2), tiny), np.array([0, 0.5], dtype))
    assert survives.tolist() == [True, False]
    assert after.tolist() == [[1, 0]] * 3
