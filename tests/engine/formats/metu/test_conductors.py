"""Fresnel reflectance of metals, against complex arithmetic in float64."""

import numpy as np
import pytest

from course.engine.terms.scattering.conductors import Conductors, conductor_reflectance

INDICES = [(0.37, 2.82), (2.9, 3.1), (1.5, 0.0), (0.05, 4.0), (0.0, 2.0), (1.0, 0.0), (0.7, 1e-4)]


def by_complex_numbers(cos_i: np.ndarray, n: float, k: float) -> np.ndarray:
    """Mean of |r_s|^2 and |r_p|^2 with Snell's law for a complex index."""
    index = n + 1j * k
    cos_t = np.sqrt(1 - (1 - cos_i**2) / index**2 + 0j)
    s = (cos_i - index * cos_t) / (cos_i + index * cos_t)
    p = (index * cos_i - cos_t) / (index * cos_i + cos_t)
    return (np.abs(s) ** 2 + np.abs(p) ** 2) / 2


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(("n", "k"), INDICES)
def test_reflectance_is_fresnels_at_every_angle(n: float, k: float, dtype: type) -> None:
    cos_i = np.linspace(0.001, 1, 200)
    columns = (np.full((3, 200), value, dtype) for value in (n, k))
    got = conductor_reflectance(cos_i.astype(dtype), *columns)
    expected = np.broadcast_to(by_complex_numbers(cos_i, n, k), (3, 200))
    np.testing.assert_allclose(got, expected, atol=3e-6 if dtype == np.float32 else 1e-9)


def test_head_on_and_grazing() -> None:
    n, k = np.full((3, 2), 0.37), np.full((3, 2), 2.82)
    got = conductor_reflectance(np.array([1.0, 0.0]), n, k)
    head_on = ((0.37 - 1) ** 2 + 2.82**2) / ((0.37 + 1) ** 2 + 2.82**2)
    np.testing.assert_allclose(got, np.array([[head_on, 1.0]] * 3))


def test_only_metals_mirror_less() -> None:
    table = Conductors(
        np.array([False, True]), np.full((3, 2), 2, np.float32), np.zeros((3, 2), np.float32)
    )
    mirror = np.array([[0.9], [0.5], [0.1]], np.float32)
    material = np.array([0, 1, 0], np.uint16)
    got = table.weakened(mirror, material, np.ones(3, np.float32))
    np.testing.assert_allclose(got, mirror * np.array([1, 1 / 9, 1]), rtol=1e-6)
    assert table.weakened(mirror, material[:1], np.ones(1, np.float32)) is mirror
