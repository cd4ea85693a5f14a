"""Points on a light of triangles: each as often as its weight says, and what arrives from them.

Numbers are drawn with fixed seeds. A statistic of N draws is held within 5.33 of its standard errors, and a chi-square
within its quantile of 1e-7: each fails by chance once in 10^7 draws of other seeds, the 5 of them together in 5e-7.
"""

import math

import numpy as np
import pytest
from scipy.stats import chi2

from course.engine.core.types import Floats32, Floats64
from course.engine.terms.lights import mesh_light
from course.engine.terms.lights.mesh_light import MeshLight, areas, shares

OFFSET = np.float32(2e-6)


def light_of(corners: Floats64) -> MeshLight:
    """A light of triangles (T, 3, 3)."""
    p0, e1, e2 = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(e1, e2)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    offset, nothing = np.full((len(corners), 1), OFFSET), np.zeros((len(corners), 2))
    planes = np.hstack((p0, normal, offset, nothing[:, :1])).astype(np.float32)
    edges = np.hstack((e1, e2, nothing)).astype(np.float32)
    return MeshLight("light 0", shares(areas(edges)), planes, edges, np.ones(3, np.float32))


def drawn(n: int, seed: int) -> Floats32:
    return np.random.default_rng(seed).random((3, n), np.float32)


SQUARE = np.array([[[0, 0, 0], [1, 0, 0], [1, 0, 1]], [[0, 0, 0], [1, 0, 1], [0, 0, 1]]], float)


def test_areas_are_half_the_vector_product() -> None:
    corners = [[[0, 0, 0], [3, 0, 0], [0, 4, 0]], [[1, 1, 1], [2, 1, 1], [1, 1, 2]]]
    assert areas(light_of(np.array(corners, float)).edges) == pytest.approx([6, 0.5])


def test_triangles_are_chosen_by_their_areas() -> None:
    """Over 50 triangles and 32 groups, what is chosen times its weight; at most 6.2 standard errors for each of 50."""
    rng = np.random.default_rng(1)
    # Lying side by side along x, so that a point tells its triangle.
    size = rng.uniform(0.1, 3, 50)
    corners = np.array([[[i, 0, 0], [i + 0.5, 0, 0], [i, 0, s]] for i, s in enumerate(size)])
    light, n = light_of(corners), 200_000
    point = np.array([[7], [-7], [7]], np.float32)
    sample = light.sample(np.repeat(point, n, axis=1), drawn(n, 2))
    found = (sample.to_light[0] + 7).astype(int)
    uniform = 7 * sample.inverse_length.astype(np.float64) ** 3
    weight = sample.factor / uniform
    share = np.bincount(found, weight, 50) / n
    square = np.bincount(found, weight**2, 50) / n
    error = np.sqrt((square - share**2) / n)
    assert (np.abs(share - size / size.sum()) < 6.2 * error).all()
    assert weight.max() / weight.min() > 10


def test_points_are_uniform_on_their_triangle() -> None:
    corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 0, 1]]], float)
    n = 200_000
    x, _, z = light_of(corners).sample(np.zeros((3, n), np.float32), drawn(n, 3)).to_light
    assert min(x.min(), z.min()) >= 0
    assert (x + z).max() <= 1 + 1e-6
    # Moments of the uniform density 2 on it: of x^a z^b they are 2 a! b! / (a + b + 2)!.
    for values, mean, square in ((x, 1 / 3, 1 / 6), (z, 1 / 3, 1 / 6), (x * z, 1 / 12, 1 / 90)):
        error = math.sqrt((square - mean**2) / n)
        assert abs(float(values.mean(dtype=np.float64)) - mean) < 5.33 * error


def test_the_irradiance_of_a_square_is_its_form_factor() -> None:
    """Above the middle of one of its corners, and facing it: a quarter of a square of twice the edge."""
    n, height = 200_000, 0.5
    points = np.repeat(np.array([[0], [-height], [0]], np.float32), n, axis=1)
    sample = light_of(SQUARE).sample(points, drawn(n, 4))
    arriving = sample.factor * sample.to_light[1] * sample.inverse_length
    a = 1 / math.hypot(1, height)
    expected = a * math.atan(a) / math.pi
    mean = float(arriving.mean(dtype=np.float64)) / math.pi
    assert abs(mean - expected) < 5.33 * float(arriving.std()) / math.pi / math.sqrt(n)


@pytest.mark.parametrize("side", [1, -1])
def test_both_sides_send_out_the_cosine_over_the_squared_distance(side: int) -> None:
    point = np.array([[0.2], [side * 3.0], [0.1]], np.float32)
    u = drawn(1000, 5)
    sample = light_of(SQUARE[:1]).sample(np.repeat(point, 1000, axis=1), u)
    d2 = (sample.to_light.astype(np.float64) ** 2).sum(axis=0)
    assert np.allclose(sample.inverse_length, 1 / np.sqrt(d2), rtol=1e-6)
    assert np.allclose(sample.factor, 3 / d2**1.5, rtol=1e-5)


@pytest.mark.parametrize("side", [1, -1])
def test_the_way_ends_above_the_side_that_is_seen(side: int) -> None:
    point = np.array([[0.2], [side * 0.25], [0.1]], np.float32)
    sample = light_of(SQUARE).sample(np.repeat(point, 100, axis=1), drawn(100, 6))
    above = side * (sample.to_light[1] + side * np.float32(0.25))
    assert above == pytest.approx(OFFSET, rel=0.02)


@pytest.mark.parametrize("height", [0, 1, -1, 1.9])
def test_a_triangle_sends_nothing_along_its_own_plane(height: float) -> None:
    """Not even to points on it, where shadow rays start; divided by the distance's square it would be anything."""
    points = np.zeros((3, 10_000), np.float32)
    points[[0, 2]] = drawn(10_000, 7)[:2]
    points[1] = np.float32(height) * OFFSET
    assert not light_of(SQUARE).sample(points, drawn(10_000, 8)).factor.any()


def test_the_ends_of_the_interval_choose_the_first_and_the_last_triangle() -> None:
    below_one = np.nextafter(np.float32(1), np.float32(0))
    corners = np.array([[[i, 0, 0], [i + 0.5, 0, 0], [i, 0, 1]] for i in range(1000)], float)
    u = np.array([[0, below_one], [0.5, 0.5], [0.5, 0.5]], np.float32)
    x = light_of(corners).sample(np.zeros((3, 2), np.float32), u).to_light[0]
    assert x.astype(int).tolist() == [0, 999]
    one = light_of(corners[:1]).sample(np.zeros((3, 2), np.float32), u)
    assert np.isfinite(one.to_light).all()


def test_the_groups_are_there_before_threads_take_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    """Made for the first sample, they would be made by every thread that takes one then."""
    light = light_of(SQUARE)
    monkeypatch.setattr(mesh_light, "make_groups", None)
    assert light.sample(np.zeros((3, 4), np.float32), drawn(4, 10)).factor.shape == (4,)


def test_many_triangles_are_chosen_evenly_in_float32() -> None:
    """A million, and each stretch of a thousandth of them as often as the others."""
    count = 1_000_000
    cumulated = shares(np.full(count, 1e-12))
    u = np.random.default_rng(9).random(400_000, np.float32)
    found = np.bincount(np.searchsorted(cumulated, u, side="right") // 1000, minlength=1000)
    assert ((found - 400) ** 2 / 400).sum() < chi2.ppf(1 - 1e-7, 999)
