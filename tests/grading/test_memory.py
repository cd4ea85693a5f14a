"""The grader's own memory is bounded while it works on other people's values."""

import sys

import numpy as np
import pytest

from course.grading import memory
from course.grading.memory import at_most

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="the account that is bounded is Linux's"
)


def test_what_is_over_the_bound_is_an_error_and_what_is_below_is_not() -> None:
    # A test process may have any size by now, and its first bound was long ago.
    memory._at_first.cache_clear()
    with at_most(200 << 20):
        np.ones(100 << 17)
        with pytest.raises(MemoryError):
            np.ones(300 << 17)
    np.ones(300 << 17)


def test_what_is_held_from_before_counts_the_next_time() -> None:
    memory._at_first.cache_clear()
    with at_most(200 << 20):
        held = np.ones(150 << 17)
    with at_most(200 << 20), pytest.raises(MemoryError):
        np.ones(150 << 17)
    del held
