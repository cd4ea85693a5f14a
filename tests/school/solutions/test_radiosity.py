"""Radiosity: gathering and shooting, again and again, solve the linear system."""

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, Array

gather = SOLUTIONS.function("radiosity", "gather")
shoot = SOLUTIONS.function("radiosity", "shoot")
needs_split = SOLUTIONS.function("radiosity", "needs_split")


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


def test_no_patches_gather_nothing() -> None:
    assert gather(*[np.zeros((3, 0))] * 3, np.zeros((0, 0))).shape == (3, 0)


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


@pytest.mark.parametrize("seed", [1, 2])
def test_shooting_converges_to_the_same_solution(seed: int) -> None:
    r = room(25, seed=seed)
    exact = limit(r)
    b = unshot = r["emission"]
    for _ in range(1500):
        i = int((unshot.sum(axis=0) * r["areas"]).argmax())
        b, unshot = shoot(b, unshot, r["reflectance"], r["areas"], r["factors"][i], i)
    assert np.allclose(b, exact, rtol=1e-6, atol=1e-8)


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


def test_a_dark_channel_counts_little() -> None:
    values = np.full((3, 3, 1), 10.0)
    values[2] = [[0.0], [0.5], [1.0]]
    assert not needs_split(values, 0.1)[0]
    assert needs_split(values, 0.099)[0]
