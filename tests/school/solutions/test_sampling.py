"""The warm-up: Marsaglia's generator is a permutation of the states."""

import numpy as np

from tests.school.solutions.contract import SOLUTIONS

xorshift32 = SOLUTIONS.function("sampling", "xorshift32")


def test_xorshift_is_one_to_one_and_keeps_zero() -> None:
    states = np.arange(1 << 16, dtype=np.uint32)
    new, _ = xorshift32(states)
    assert new[0] == 0
    assert np.unique(new).size == states.size
