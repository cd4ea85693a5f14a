"""Environment light: weights, densities and tables against closed forms, and at the ends of what floats can hold."""

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, frozen, unit

NAMES = ("texel_weights", "cumulate", "sample_direction", "density", "alias_table", "draw_alias")
texel_weights, cumulate, sample_direction, density, alias_table, draw_alias = (
    SOLUTIONS.function("environment_light", name) for name in NAMES
)

LAST = np.nextafter(1.0, 0.0)


def test_the_upper_half_of_a_picture_is_half_of_the_sphere() -> None:
    weights = texel_weights(frozen(np.ones((6, 5, 3))))
    assert weights[:3].sum() == pytest.approx(2 * np.pi, rel=1e-14)
    assert weights.sum() == pytest.approx(4 * np.pi, rel=1e-14)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_last_number_below_1_finds_a_texel_with_weight(dtype: type) -> None:
    """Also in a late row, where adding the row's number to it could round up to the next row."""
    weights = np.zeros((900, 3))
    weights[899] = 0, 5, 0
    weights[0, 1] = 1
    rows, columns = cumulate(weights)
    last = np.nextafter(dtype(1), dtype(0))
    u = np.array([[0, last, last, 0], [0, last, 0, last]], dtype)
    directions = sample_direction(rows, columns, frozen(u))
    assert np.isfinite(directions).all()
    assert (density(weights, directions) > 0).all()


def test_one_row_of_one_texel_is_the_whole_sphere() -> None:
    rows, columns = cumulate(np.array([[3.0]]))
    directions = sample_direction(rows, columns, unit(2, 20_000, np.float64, seed=1))
    # The mean of 20,000 uniform directions is off by 5 of its standard errors once in 600,000 runs, in each axis.
    assert np.abs(directions.mean(axis=1)).max() < 5 / np.sqrt(3 * 20_000)
    assert density(np.array([[3.0]]), directions) == pytest.approx(1 / (4 * np.pi))


def test_densities_integrate_to_1() -> None:
    weights = np.random.default_rng(0).random((7, 9))
    edge = np.cos(np.pi * np.arange(8) / 7)
    theta, phi = np.pi * (np.arange(7) + 0.5) / 7, 2 * np.pi * ((np.arange(9) + 0.5) / 9 - 0.5)
    t, p = (x.ravel() for x in np.meshgrid(theta, phi, indexing="ij"))
    direction = np.stack((np.sin(t) * np.sin(p), np.cos(t), -np.sin(t) * np.cos(p)))
    solid_angle = np.repeat(2 * np.pi / 9 * (edge[:-1] - edge[1:]), 9)
    assert density(weights, direction) @ solid_angle == pytest.approx(1, rel=1e-13)


@pytest.mark.parametrize("largest", [1e-300, 1.0, 1e300])
def test_tables_share_out_weights_of_any_size(largest: float) -> None:
    weights = largest * np.array([0.3, 0, 1, 0.02, 0, 0.7])
    probability, alias = alias_table(frozen(weights))
    own = probability.copy()
    np.add.at(own, alias, 1 - probability)
    assert own / 6 == pytest.approx(weights / largest / 2.02, abs=1e-15)
    u = np.append(np.arange(6) / 6, LAST)
    outcome, rest = draw_alias(probability, alias, frozen(u))
    assert (weights[outcome] > 0).all()
    assert ((rest >= 0) & (rest <= 1)).all()


def test_a_picture_without_light_is_refused() -> None:
    for function, zeros in ((cumulate, np.zeros((2, 3))), (alias_table, np.zeros(4))):
        with pytest.raises(ValueError, match="weights must be >= 0, and not 0 everywhere"):
            function(zeros)
    with pytest.raises(ValueError, match="image must be >= 0"):
        texel_weights(-np.ones((2, 2, 3)))
