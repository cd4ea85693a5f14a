"""Multiple importance sampling: densities, weights and estimators against closed forms."""

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, frozen

NAMES = (
    *("area_density", "cone_density", "heuristic_weights", "delta_weights"),
    *("multi_sample", "one_sample"),
)
area_density, cone_density, heuristic_weights, delta_weights, multi_sample, one_sample = (
    SOLUTIONS.function("multiple_importance", name) for name in NAMES
)


def test_a_lamp_s_density_adds_up_to_1_over_the_directions_that_it_fills() -> None:
    """Over a square of side 2 at distance 1: the solid angle of a cube's face is a sixth of the sphere."""
    a, b = np.meshgrid(*[(np.arange(500) + 0.5) / 250 - 1] * 2)
    distance = np.sqrt(1 + a * a + b * b).ravel()
    found = area_density(4.0, frozen(distance), frozen(1 / distance))
    assert (4 / len(distance) / (4 * found)).sum() == pytest.approx(4 * np.pi / 6, rel=1e-5)


def test_a_ball_that_fills_half_of_the_directions_has_the_hemisphere_s_density() -> None:
    found = cone_density(1.0, frozen(np.array([1 + 1e-12, 1.0, 0.3])))
    assert found == pytest.approx([1 / (2 * np.pi), 0, 0], rel=1e-5)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_distant_ball_is_a_disk(dtype: type) -> None:
    distance = np.array([1e3, 1e5, 1e7], dtype)
    assert cone_density(1.0, distance) * np.pi / distance**2 == pytest.approx(np.ones(3), rel=1e-5)


def test_the_balance_heuristic_is_the_mixture_s_share() -> None:
    weights = heuristic_weights(np.array([3, 1]), frozen(np.array([[2.0, 0, 0], [6.0, 5, 0]])), 1.0)
    assert weights.tolist() == [[0.5, 0, 0], [0.5, 1, 0]]


@pytest.mark.parametrize("size", [1e-300, 1e-30, 1.0, 1e30, 1e300])
def test_weights_depend_on_ratios_alone(size: float) -> None:
    found = heuristic_weights(np.array([1, 2]), size * np.array([[2.0], [1.0]]), 3.0)
    assert found.ravel().tolist() == [0.5, 0.5]


def test_a_delta_takes_all_where_it_draws_and_nothing_elsewhere() -> None:
    densities = frozen(np.array([[0.5, 0.0], [90.0, 90.0]]))
    delta = np.array([[True, True], [False, False]])
    assert delta_weights(np.array([1, 7]), densities, delta).tolist() == [[1, 0], [0, 1]]


def test_one_sample_with_balance_weights_is_the_mixture_s_estimate() -> None:
    odds, densities = np.array([0.25, 0.75]), np.array([[8.0, 0.0], [2.0, 0.0]])
    f = frozen(np.array([[7.0, 1], [0, 1], [3.5, 1]]))
    assert one_sample(odds, f, densities).tolist() == [[2, 0], [0, 0], [1, 0]]


def test_balance_weights_leave_one_estimate_of_f_over_the_sum_of_n_p() -> None:
    rng = np.random.default_rng(4)
    counts, densities = np.array([5, 2, 9]), rng.random((3, 16))
    strategy, f = np.repeat([0, 1, 2], counts), rng.random((3, 16))
    weights = heuristic_weights(counts, densities, 1.0)
    own = strategy, np.arange(16)
    found = multi_sample(counts, strategy, f, densities[own], weights[own])
    assert found == pytest.approx((f / (counts @ densities)).sum(axis=1), rel=1e-12)
