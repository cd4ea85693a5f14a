"""The grader's own memory is bounded while it works on other people's values."""

import sys

import numpy as np
import pytest

from course.grading.memory import at_most

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="the account that is bounded is Linux's"
)


def test_what_is_over_the_bound_is_an_error_and_what_is_below_is_not() -> None:
    with at_most(200 << 20):
        np.ones(100 << 17)
        with pytest.raises(MemoryError):
            np.ones(300 << 17)
    np.ones(300 << 17)


def test_a_bound_ends_with_its_context() -> None:
    with at_most(1 << 20), pytest.raises(MemoryError):
        np.ones(10 << 17)
    np.ones(10 << 17)
