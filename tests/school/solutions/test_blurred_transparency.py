"""Blurred transparency: the way back of light, and the reflectance by another formula."""

import math

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, Array, directions

MODULE = "blurred_transparency"
refract = SOLUTIONS.function(MODULE, "refract")
fresnel = SOLUTIONS.function(MODULE, "fresnel")


ETAS = [0.1, 1 / 1.5, 1.0, 1.33, 2.4, 10.0]


def rays(sine: Array) -> tuple[Array, Array]:
    """Directions and normals with those sines between them."""
    n = directions(sine.size, np.float64, 0)
    along = np.cross(n.T, directions(sine.size, np.float64, 1).T).T
    along /= np.linalg.norm(along, axis=0)
    return sine * along - np.sqrt(1 - sine**2) * n, n


def test_light_takes_the_same_way_back() -> None:
    for eta in ETAS:
        d, n = rays(np.linspace(0, 0.999 * min(1, 1 / eta), 500))
        there, _ = refract(d, n, eta)
        back, total = refract(-there, -n, 1 / eta)
        assert not total.any()
        assert np.abs(back + d).max() < 1e-10


@pytest.mark.parametrize("n", [1.33, 1.5, 2.4])
def test_reflectance_by_sines_and_tangents(n: float) -> None:
    for eta in (n, 1 / n):
        i = np.linspace(0.01, math.asin(min(1, 1 / eta)) - 0.01, 500)
        t = np.arcsin(eta * np.sin(i))
        s = (np.sin(i - t) / np.sin(i + t)) ** 2
        p = (np.tan(i - t) / np.tan(i + t)) ** 2
        assert fresnel(np.cos(i), eta) == pytest.approx((s + p) / 2, rel=1e-9)
        # The other side of the boundary reflects the same share.
        assert fresnel(np.cos(t), 1 / eta) == pytest.approx((s + p) / 2, rel=1e-9)
