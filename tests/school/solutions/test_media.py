"""media against closed forms that the checks don't ask: moments of the lobe, and densities along a way.

Means are within 5.33 standard errors: a false-fail rate of 1e-7 for each of six numbers.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import eval_legendre

from tests.school.solutions.contract import SOLUTIONS


def of(name: str) -> Callable[..., Any]:
    return SOLUTIONS.function("media", name)


@pytest.mark.parametrize("g", [-0.8, 0.0, 0.3, 0.95])
@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_moments_of_the_lobe_are_powers_of_g(g: float, order: int) -> None:
    """The Legendre moments of Henyey and Greenstein's function are g^n."""

    def moment(cos: float) -> float:
        value = of("henyey_greenstein")(np.array([cos]), g)[0]
        return float(2 * np.pi * value * eval_legendre(order, cos))

    assert quad(moment, -1, 1, limit=200)[0] == pytest.approx(g**order, abs=1e-6)


@pytest.mark.parametrize("g", [-0.8, 0.3])
def test_scattered_light_has_these_moments(g: float) -> None:
    n = 200_000
    rng = np.random.default_rng(1)
    came = np.repeat([[0.36], [0.48], [-0.8]], n, axis=1)
    way, _ = of("sample_henyey_greenstein")(came, g, rng.random((2, n)))
    for order in (1, 2):
        found = eval_legendre(order, (came * way).sum(axis=0))
        assert abs(found.mean() - g**order) <= 5.33 * found.std() / n**0.5


def test_flights_and_shares_agree_with_the_integrated_density() -> None:
    """A ray along the diagonal of a grid, whose trilinear density SciPy's quadrature integrates."""
    n = 100_000
    rng = np.random.default_rng(2)
    grid = rng.uniform(0.2, 3, (3, 2, 4))
    start, way = np.array([0.1, 0.9, 0.05]), np.array([0.7, -0.6, 0.8])

    def density(t: float) -> float:
        size = np.array(grid.shape)
        place = np.clip((start + t * way) * size - 0.5, 0, size - 1)
        low = np.minimum(place.astype(int), size - 2)
        x, y, z = place - low
        cube = grid[tuple(slice(a, a + 2) for a in low)]
        return float(np.einsum("i,j,k,ijk->", (1 - x, x), (1 - y, y), (1 - z, z), cube))

    expected = np.exp(-quad(density, 0, 1, limit=400)[0])
    rays = np.repeat(start[:, None], n, 1), np.repeat(way[:, None], n, 1), np.ones(n)
    _, collided = of("delta_tracking")(grid, 3.0, *rays, rng.random((2, 40, n)))
    share, _ = of("ratio_tracking")(grid, 3.0, *rays, rng.random((40, n)))
    for found in (~collided, share):
        assert abs(found.mean() - expected) <= 5.33 * found.std() / n**0.5
