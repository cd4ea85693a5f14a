"""Antialiasing: a pixel that a straight edge crosses shows the share of it that the edge covers.

The edge is that of a large white plate before black. It cuts at most 2 k - 1 of a pixel's k x k cells; the others
count exactly. A half-plane that holds a cell's centre covers at least half of the cell, so centres err by at most
half a cell for each cell that is cut, and any other point of the cell by less than one. Independent points make a
binomial distribution.
"""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from tests.conftest import MakeScene
from tests.lengths import fewer

Array = NDArray[np.float64]
SIZE = 24
ANGLE = 0.4123
OFFSET = 0.0137
NORMAL = np.array([math.cos(ANGLE), math.sin(ANGLE)])
"""White is where NORMAL . (x, y) < OFFSET on the plane z = 0, which the picture shows from -1 to 1."""


def edge(
    make_scene: MakeScene, angle: float = ANGLE, offset: float = OFFSET, **film: object
) -> Scene:
    plate = {"shape": "quad", "material": "white", "width": 8, "depth": 8}
    plate |= {
        "transform": [
            {"rotate": {"axis": [1, 0, 0], "degrees": 90}},
            {"translate": [offset - 4, 0, 0]},
            {"rotate": {"axis": [0, 0, 1], "degrees": math.degrees(angle)}},
        ]
    }
    return make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0]}
        | {"vertical_fov": math.degrees(2 * math.atan(1 / 4))},
        film={"width": SIZE, "height": SIZE} | film,
        materials={"white": {"color": 1, "diffuse": 0}},
        objects=[plate],
        lights=[{"type": "ambient", "radiance": 1}],
    )


def distance(offsets: Array) -> Array:
    """How far picture points lie beyond the edge; (SIZE, SIZE, ...) for offsets (2, ...) in the pixel."""
    column = np.arange(SIZE).reshape((1, SIZE) + (1,) * (offsets.ndim - 1))
    row = np.arange(SIZE).reshape((SIZE, 1) + (1,) * (offsets.ndim - 1))
    x = 2 * (column + offsets[0]) / SIZE - 1
    y = 1 - 2 * (row + offsets[1]) / SIZE
    return np.asarray(NORMAL[0] * x + NORMAL[1] * y - OFFSET)


def coverage() -> Array:
    """(SIZE, SIZE) exact, by the integral of a half-plane's indicator over a square.

    The square's area below a line is a second difference of max(s, 0)^2 / 2 at its corners, since that is what two
    integrations along the axes make of a step.
    """
    corners = np.stack(np.meshgrid([0.0, 1.0], [0.0, 1.0]))
    s = np.maximum(-distance(corners), 0) ** 2 / 2
    second = s[..., 0, 0] - s[..., 0, 1] - s[..., 1, 0] + s[..., 1, 1]
    # d distance / d offset is a step of a pixel along x, and one against y.
    return np.asarray(second / -(2 / SIZE * NORMAL[0]) / (2 / SIZE * NORMAL[1]) * 1.0)


def picture(scene: Scene, sampler: str, samples: int, seed: int = 1) -> Array:
    linear = render(scene, sampler=sampler, spp=samples, seed=seed).linear
    assert np.array_equal(linear[..., 0], linear[..., 2])
    return linear[..., 0].astype(np.float64)


def test_the_exact_coverage_is_the_limit_of_a_fine_grid() -> None:
    centre = (np.arange(64) + 0.5) / 64
    fine = (distance(np.stack(np.meshgrid(centre, centre))) < 0).mean(axis=(2, 3))
    assert np.abs(coverage() - fine).max() <= (2 * 64 - 1) / (2 * 64**2)
    assert ((coverage() > 0.01) & (coverage() < 0.99)).sum() > SIZE, "the edge is in the picture"


@pytest.mark.parametrize("k", [1, 2, 4, 8])
def test_regular_counts_the_centres_on_the_plate(make_scene: MakeScene, k: int) -> None:
    centre = (np.arange(k) + 0.5) / k
    beyond = distance(np.stack(np.meshgrid(centre, centre)))
    shown = picture(edge(make_scene), "regular", k * k)
    # The only doubt is about centres within float32 of the edge, and there are none.
    assert np.abs(beyond).min() > 1e-5
    assert np.allclose(shown, (beyond < 0).mean(axis=(2, 3)), rtol=0, atol=1e-6)
    assert np.abs(shown - coverage()).max() <= (2 * k - 1) / (2 * k * k) + 1e-6


@pytest.mark.parametrize("sampler", ["jittered", "sobol"])
@pytest.mark.parametrize("k", [2, 4, 8, 16])
def test_one_point_in_each_cell_errs_by_the_cells_that_are_cut(
    make_scene: MakeScene, sampler: str, k: int
) -> None:
    # No randomness can break this bound: no false fail. A (0, 2)-sequence has one point in each cell, too.
    error = picture(edge(make_scene), sampler, k * k) - coverage()
    assert np.abs(error).max() < (2 * k - 1) / k**2 + 1e-6


def test_jittered_points_are_right_on_average_and_beat_random_ones(make_scene: MakeScene) -> None:
    # Errors of cut cells are independent with variances up to 1/4, so by Hoeffding a pixel's error is beyond t with
    # 2 exp(-2 t^2 k^4 / (2 k - 1)); at that t it is 1e-12 for each of the 24 x 24 x 4 pixels.
    k = 8
    t = math.sqrt(math.log(2e12) / 2 * (2 * k - 1)) / k**2
    errors = np.stack(
        [picture(edge(make_scene), "jittered", k * k, seed) - coverage() for seed in range(4)]
    )
    assert np.abs(errors).max() < t
    p = coverage()
    cut = (p > 0.05) & (p < 0.95)
    variance = (p * (1 - p) / k**2)[cut].mean()
    # At most (2 k - 1) / 4 k^4 against p (1 - p) / k^2: less than half, in 4 x about 40 pixels.
    assert (errors[:, cut] ** 2).mean() < 0.5 * variance
    # Their sum has that standard deviation: 5 of it are 6e-7.
    assert abs(errors.sum()) < 5 * math.sqrt(4 * cut.sum() * (2 * k - 1) / 4 / k**4)


def test_random_points_are_binomial(make_scene: MakeScene) -> None:
    # z is standardised, its square has mean 1; over m = 8 x about 40 pixels its variance is below 3 for these p, so 5
    # of its standard deviations, 6e-7. The sum of z has variance m: again 6e-7.
    n = 64
    p = coverage()
    cut = (p > 0.1) & (p < 0.9)
    shown = np.stack([picture(edge(make_scene), "random", n, seed) for seed in range(8)])
    assert np.array_equal(shown[:, p <= 0], np.zeros((8, (p <= 0).sum())))
    z = ((shown - p) / np.sqrt(np.where(cut, p * (1 - p), 1) / n))[:, cut]
    assert abs((z**2).mean() - 1) < 5 * math.sqrt(3 / z.size)
    assert abs(z.sum()) < 5 * math.sqrt(z.size)


@fewer
@pytest.mark.parametrize("sampler", ["sobol", "random", "jittered", "regular"])
@pytest.mark.parametrize("sigma", [1 / 6, 0.4])
def test_a_gaussian_filter_shows_the_truncated_normal_distribution_across_an_edge(
    make_scene: MakeScene, sampler: str, sigma: float
) -> None:
    # The edge leans by one pixel over the height of the picture, so that each row shows another point of the profile.
    # The error of a ratio of means of n independent points has a variance of E[w^2 (1 - F)^2 ...] / E[w]^2 / n, and w
    # is at most 1 with E[w] = area: 6 of the largest such standard deviations, 2e-9 for each of 48 pixels. The other
    # patterns are better than that.
    n = 4096
    lean = math.atan(1 / SIZE)
    scene = edge(make_scene, angle=lean, offset=0.5 / SIZE, filter="gaussian", sigma=sigma)
    shown = picture(scene, sampler, n)
    row = np.arange(SIZE)
    fine = (np.arange(200) + 0.5) / 200
    gauss = np.exp(-((fine - 0.5) ** 2) / (2 * sigma**2))
    half = 0.5 / (sigma * math.sqrt(2))
    area = (sigma * math.sqrt(2 * math.pi) * math.erf(half)) ** 2
    tolerance = 6 * math.sqrt(0.25 * area / area**2 / n)
    y = 1 - 2 * (row[:, None] + fine) / SIZE
    position = (0.5 / SIZE - math.sin(lean) * y) / math.cos(lean)
    for column in range(SIZE // 2 - 2, SIZE // 2 + 3):
        # Where the edge is in the pixel, at each height; what is left of it is white.
        d = np.clip((position + 1) * SIZE / 2 - column - 0.5, -0.5, 0.5)
        erf = np.vectorize(math.erf)(d / (sigma * math.sqrt(2)))
        profile = ((erf / math.erf(half) + 1) / 2) @ gauss / gauss.sum()
        assert np.abs(shown[:, column] - profile).max() < tolerance
    # White is the sum of 4096 shares, rounded to float32 each.
    assert np.abs(shown[:, : SIZE // 2 - 2] - 1).max() < 1e-5
    assert not shown[:, SIZE // 2 + 2 :].any()
