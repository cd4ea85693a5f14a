"""Low discrepancy: Halton's points as SciPy has them, and chained patterns that know nothing of each other."""

import numpy as np
import pytest
from scipy.stats import qmc

from tests.school.solutions.contract import SOLUTIONS, Array, frozen

radical_inverse = SOLUTIONS.function("quasi_monte_carlo", "radical_inverse")
halton = SOLUTIONS.function("quasi_monte_carlo", "halton")
hammersley = SOLUTIONS.function("quasi_monte_carlo", "hammersley")
chain = SOLUTIONS.function("quasi_monte_carlo", "chain")

PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)


@pytest.mark.parametrize("base", [2, 3, 7])
def test_radical_inverses_stay_below_1(base: int) -> None:
    i = np.array([base**k - 1 for k in range(1, 21)] + [2**63 - 1], np.int64)
    found = radical_inverse(base, i)
    assert (found < 1).all()
    # All but the smallest difference from 1, which single precision would round away.
    assert found.max() == np.float32(1 - 2**-24)


def test_halton_is_scipys_sequence() -> None:
    expected = qmc.Halton(len(PRIMES), scramble=False).random(500).T
    points = halton(np.arange(500), len(PRIMES))
    assert points.dtype == np.float32
    assert np.abs(points - expected).max() < 1e-7


def patterns(s: int) -> tuple[Array, ...]:
    """Lens, light, time and gloss."""
    rng = np.random.default_rng(2)
    kinds = ((2, np.float32), (2, np.float64), (1, np.float32), (3, np.float64))
    return tuple(frozen(rng.random((d, s)).astype(dtype)) for d, dtype in kinds)


def test_effects_are_not_correlated() -> None:
    """Of rays that all see the same pixel, lens and light have nothing to do with each other."""
    s = 1024
    grid = hammersley(s, 2)
    lens, light = chain((grid, grid), np.arange(s), np.random.default_rng(6))
    correlation = np.corrcoef(np.concatenate((lens, light)))[:2, 2:]
    assert np.abs(correlation).max() < 5 / np.sqrt(s)


def test_no_rays_and_no_patterns() -> None:
    none = np.empty(0, np.int64)
    assert [x.shape for x in chain(patterns(4), none, np.random.default_rng(0))] == [
        (2, 0),
        (2, 0),
        (1, 0),
        (3, 0),
    ]
    assert chain((), none, np.random.default_rng(0)) == ()
