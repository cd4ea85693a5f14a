"""Radiosity: delta form factors against exact integrals, and the linear system that gathering and shooting solve."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import SOLUTIONS, Array

hemicube_form_factors = SOLUTIONS.function("radiosity", "hemicube_form_factors")
gather = SOLUTIONS.function("radiosity", "gather")
shoot = SOLUTIONS.function("radiosity", "shoot")
needs_split = SOLUTIONS.function("radiosity", "needs_split")

dtypes = pytest.mark.parametrize("dtype", DTYPES)


# ---------------------------------------------------------------- the hemicube


def integrated(k: int) -> tuple[Array, Array]:
    """Integrals of cos cos' / (pi r^2) over each cell, by 8 x 8 points of Gauss and Legendre."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    half = 1 / k
    edges = np.linspace(-1, 1, k + 1)[:-1]
    x = edges[:, None] + half * (1 + nodes)
    z = x[k // 2 :]

    def over_cells(f: Any, rows: Array, columns: Array) -> Array:
        value = f(columns[None, None], rows[:, :, None, None])
        return half**2 * np.einsum("ipjq,p,q->ij", value, weights, weights)

    def above(x: Array, y: Array) -> Array:
        r2 = x**2 + y**2 + 1
        return (1 / np.sqrt(r2)) ** 2 / (math.pi * r2)

    def beside(x: Array, z: Array) -> Array:
        r2 = x**2 + z**2 + 1
        return z / np.sqrt(r2) * (1 / np.sqrt(r2)) / (math.pi * r2)

    return over_cells(above, x, x), over_cells(beside, z, x)


def test_the_yardstick_knows_the_form_factor_of_a_square() -> None:
    top, side = integrated(8)
    assert top.sum() == pytest.approx(
        4 / math.pi / math.sqrt(2) * math.atan(1 / math.sqrt(2)), abs=1e-12
    )
    assert top.sum() + 4 * side.sum() == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("k", [2, 4, 6, 32, 128])
def test_delta_form_factors_are_the_integrals_to_the_grids_accuracy(k: int) -> None:
    found = hemicube_form_factors(k)
    for part, exact in zip(found, integrated(k), strict=True):
        assert part.dtype == np.float32
        assert part.shape == exact.shape
        # The midpoint rule's error is h^2 / 24 times second derivatives, which stay below 15 times the largest value.
        assert np.abs(part - exact).max() <= 15 / 24 * 2 * (2 / k) ** 2 * exact.max() + 1e-9
    total = found[0].sum(dtype=float) + 4 * found[1].sum(dtype=float)
    assert abs(total - 1) <= 0.7 / k**2


@pytest.mark.parametrize("part", [0, 1], ids=["top", "side"])
def test_halving_the_cells_leaves_a_fourth_of_the_error(part: int) -> None:
    errors = []
    for k in (16, 32, 64):
        found, exact = hemicube_form_factors(k)[part], integrated(k)[part]
        # Of a cell's own factor, far over the 2^-24 to which it was rounded.
        errors.append(np.abs(found / exact - 1).max())
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)


def test_the_hemicube_is_as_symmetric_as_it_looks() -> None:
    top, side = hemicube_form_factors(12)
    for turned in (top.T, top[::-1], top[:, ::-1]):
        assert np.allclose(top, turned, rtol=1e-6, atol=0)
    assert np.allclose(side, side[:, ::-1], rtol=1e-6, atol=0)
    # A low cell counts little, for light hardly leaves along the surface.
    assert (side[0] < 0.3 * side[2]).all()


@pytest.mark.parametrize("k", [0, 1, 3, 17, -2, 2.5, math.nan])
def test_a_hemicube_that_can_not_be_halved_is_refused(k: float) -> None:
    with pytest.raises(ValueError, match=f"^k must be even and >= 2, got {k}$"):
        hemicube_form_factors(k)


# ---------------------------------------------------------------- rooms


def room(patches: int, dtype: type = np.float64, seed: int = 0) -> dict[str, Array]:
    """A closed room: A_i F[i, j] is symmetric, and rows sum to 1 but for the light of patches to themselves."""
    rng = np.random.default_rng(seed)
    exchanged = rng.random((patches, patches)) ** 2
    exchanged = exchanged + exchanged.T
    np.fill_diagonal(exchanged, 0)
    areas = exchanged.sum(axis=1)
    areas[areas == 0] = 1
    return {
        "emission": (rng.random((3, patches)) * (rng.random(patches) < 0.3)).astype(dtype),
        "reflectance": rng.uniform(0.1, 0.9, (3, patches)).astype(dtype),
        "areas": areas.astype(dtype),
        "factors": (exchanged / areas[:, None]).astype(dtype),
    }


def limit(r: dict[str, Array]) -> Array:
    """(I - rho F) B = E."""
    identity = np.eye(len(r["areas"]))
    return np.stack(
        [
            np.linalg.solve(
                identity - r["reflectance"][c][:, None] * r["factors"], r["emission"][c]
            )
            for c in range(3)
        ]
    )


def arguments(r: dict[str, Array], name: str) -> dict[str, Any]:
    given = {"radiosity": r["emission"] + 1, "reflectance": r["reflectance"]}
    if name == "gather":
        return {**given, "emission": r["emission"], "form_factors": r["factors"]}
    return {
        **given,
        "unshot": r["emission"] + r["emission"].dtype.type(0.5),
        "areas": r["areas"],
        "form_factors": r["factors"][2],
        "shooter": 2,
    }


def results(name: str, given: dict[str, Any]) -> tuple[Array, ...]:
    value = (gather if name == "gather" else shoot)(**given)
    return value if isinstance(value, tuple) else (value,)


functions = pytest.mark.parametrize("name", ["gather", "shoot"])


def test_no_patches_gather_nothing() -> None:
    assert gather(*[np.zeros((3, 0))] * 3, np.zeros((0, 0))).shape == (3, 0)


@pytest.mark.parametrize("shooter", [-1, 5, 100])
def test_only_a_patch_shoots(shooter: int) -> None:
    given = {**arguments(room(5), "shoot"), "shooter": shooter}
    with pytest.raises(ValueError, match=f"^shooter must be from 0 to 4, got {shooter}$"):
        shoot(**given)


# ---------------------------------------------------------------- the system


def test_the_fixed_point_of_gathering_solves_the_system() -> None:
    r = room(40)
    exact = limit(r)
    after = gather(exact, r["emission"], r["reflectance"], r["factors"])
    assert np.allclose(after, exact, rtol=1e-12, atol=1e-13)


def test_gathering_converges_as_fast_as_light_is_absorbed() -> None:
    r = room(40)
    exact, rho = limit(r), r["reflectance"].max()
    b = np.zeros_like(exact)
    error = np.abs(exact).max()
    for _ in range(200):
        b = gather(b, r["emission"], r["reflectance"], r["factors"])
        # Row sums are at most 1, so the largest error shrinks by rho at least.
        assert np.abs(b - exact).max() <= rho * error * (1 + 1e-12) + 1e-13
        error = np.abs(b - exact).max()
    assert error < 1e-8


def test_the_nth_iteration_holds_n_reflections() -> None:
    """Two parallel plates, F between them f: B of the lamp's plate is a geometric series in rho^2 f^2."""
    f, rho = 0.4, 0.7
    factors = np.array([[0, f], [f, 0]])
    emission = np.array([[1.0, 0.0]] * 3)
    b = emission
    for n in range(1, 9):
        b = gather(b, emission, np.full((3, 2), rho), factors)
        series = sum((rho * f) ** (2 * m) for m in range(n // 2 + 1))
        assert b[0, 0] == pytest.approx(series, rel=1e-13)


@pytest.mark.parametrize("seed", [1, 2])
def test_shooting_converges_to_the_same_solution(seed: int) -> None:
    r = room(25, seed=seed)
    exact = limit(r)
    b = unshot = r["emission"]
    for _ in range(1500):
        i = int((unshot.sum(axis=0) * r["areas"]).argmax())
        b, unshot = shoot(b, unshot, r["reflectance"], r["areas"], r["factors"][i], i)
    assert np.allclose(b, exact, rtol=1e-6, atol=1e-8)


def test_what_is_missing_is_what_the_unshot_light_still_brings() -> None:
    """B* - B = (I - rho F)^-1 rho F unshot, after any number of shots."""
    r = room(15)
    exact = limit(r)
    b = unshot = r["emission"]
    for i in (3, 0, 7, 3, 14, 5):
        b, unshot = shoot(b, unshot, r["reflectance"], r["areas"], r["factors"][i], i)
        arriving = gather(unshot, np.zeros_like(unshot), r["reflectance"], r["factors"])
        rest = limit({**r, "emission": arriving})
        assert np.allclose(exact - b, rest, rtol=1e-11, atol=1e-13)


def test_a_shot_neither_makes_nor_loses_power() -> None:
    r = room(30)
    unshot = r["emission"] + 0.1
    for i in range(30):
        power = unshot @ r["areas"]
        white = np.ones_like(unshot)
        b, after = shoot(unshot, unshot, white, r["areas"], r["factors"][i], i)
        assert np.allclose(after @ r["areas"], power, rtol=1e-13)
        assert (after[:, i] == 0).all()
        assert (b[:, i] == unshot[:, i]).all()
        unshot = after


def test_a_shot_brings_each_receiver_its_share() -> None:
    """A lamp of 4 m^2 and 10 W/m^2 sends a tenth of its 40 W to a patch of 2 m^2 that reflects half: 1 W/m^2."""
    b, unshot = shoot(
        np.array([[10.0, 0]] * 3),
        np.array([[10.0, 0]] * 3),
        np.full((3, 2), 0.5),
        np.array([4.0, 2.0]),
        np.array([0, 0.1]),
        0,
    )
    assert b[0].tolist() == [10, 1]
    assert unshot[0].tolist() == [0, 1]


# ---------------------------------------------------------------- subdivision


@pytest.mark.parametrize("wrong", [-1.0, -1e-45, math.nan, -math.inf])
def test_a_threshold_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^threshold must be >= 0, got {wrong}$"):
        needs_split(np.ones((3, 3, 2)), wrong)


@dtypes
@pytest.mark.parametrize("scale", [2.0**-40, 1.0, 2.0**40])
def test_contrast_is_what_is_over_the_threshold_and_not_light(dtype: type, scale: float) -> None:
    for lowest, split in ((0.75, False), (0.74, True), (1.0, False), (0.0, True)):
        for channel in range(3):
            values = np.full((3, 3, 1), scale, dtype)
            values[channel, 1] = lowest * scale
            assert needs_split(values, 0.25)[0] == split


def test_a_dark_channel_counts_little() -> None:
    values = np.full((3, 3, 1), 10.0)
    values[2] = [[0.0], [0.5], [1.0]]
    assert not needs_split(values, 0.1)[0]
    assert needs_split(values, 0.099)[0]


def test_black_patches_stay_whole() -> None:
    assert not needs_split(np.zeros((3, 4, 6)), 0.0).any()
