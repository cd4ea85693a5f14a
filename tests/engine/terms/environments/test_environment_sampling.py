"""Directions from tables: what is drawn, with what density, and how little variance that leaves.

The density is worked out here from the tables alone: the probability of a direction's texel over the texel's solid
angle, by the place that the cube_map module gives the direction. Statistical tests have fixed seeds, and false-fail
rates of 1e-6 each: 4.9 standard errors, or the chi-squared of Wilson and Hilferty at 4.75.
"""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.core.samplers import Block
from course.engine.formats.pictures.reading import read_picture
from course.engine.functions.effects import Effects
from course.engine.terms.environments.cube_faces import (
    cube_from_cross,
    cube_from_lat_long,
)
from course.engine.terms.environments.sampling import (
    CELLS,
    NORMALS,
    ProductSampling,
    nearest_normal,
    product_sampling,
    tabulated,
)
from course.engine.terms.samplers.sobol import SobolSampler
from course.engine.terms.scattering.hemisphere import cosine_directions
from tests.engine.terms.environments.skies import by_texel
from tests.lengths import fewer

Array = NDArray[np.float64]
Faces = NDArray[np.float32]
Lookup = Callable[[NDArray[np.floating], NDArray[np.floating]], NDArray[np.floating]]

PICTURES = Path(__file__).parents[4] / "scenes" / "environments"
EFFECTS = Effects("solutions")
LOOKUPS: dict[bool, Lookup] = {
    True: EFFECTS.function("cube_map", "lookup_seamless"),
    False: EFFECTS.function("cube_map", "lookup"),
}
UNIT = 2.0**-24
LAST = np.float32(1 - UNIT)


def unit(*vector: float) -> NDArray[np.float32]:
    return (np.array(vector) / np.linalg.norm(vector)).astype(np.float32)


def sun(size: int = 256, radiance: float = 40000.0, row: int | None = None) -> Faces:
    """A sky with a sun of one texel: of 256, it is as wide as the real one, and four times as strong as the sky."""
    faces = np.full((6, size, size, 3), (0.5, 0.7, 1.0), np.float32)
    faces[2, size // 4 if row is None else row, size // 3] += np.float32(radiance)
    return faces


def waves(size: int = 40) -> Faces:
    """A sky that turns a few times in every direction, a third of it black."""
    d = by_texel(size)[..., 0, :]
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    value = np.sin(5 * d[..., 0] + 1) + np.sin(7 * d[..., 1]) + np.sin(6 * d[..., 2] + 2)
    return (np.maximum(value - 0.4, 0)[..., None] * (1.0, 0.5, 0.2)).astype(np.float32)


def drawn_by(faces: Faces, seamless: bool = True) -> ProductSampling:
    product = product_sampling(faces, seamless)
    assert product is not None
    return product


def probabilities(product: ProductSampling, normal: NDArray[np.float32]) -> Array:
    """Of every texel (6, size, size), for one normal."""
    table = int(nearest_normal(normal[:, None])[0])
    rows = np.diff(product.rows.edges.astype(float))[table]
    columns = np.diff(product.columns.edges.astype(float)).reshape(-1, 6 * CELLS, CELLS)[table]
    texel_rows = np.diff(product.texel_rows.edges.astype(float))
    split = texel_rows.shape[1]
    texel_columns = np.diff(product.texel_columns.edges.astype(float)).reshape(-1, split, split)
    cells = (rows[:, None] * columns).ravel()
    texels = cells[:, None, None] * texel_rows[:, :, None] * texel_columns
    faces = texels.reshape(6, CELLS, CELLS, split, split).swapaxes(2, 3)
    return np.asarray(faces.reshape(6, CELLS * split, CELLS * split))


def places(direction: NDArray[np.floating], size: int) -> tuple[NDArray[np.intp], Array, Array]:
    """Face, column and row of directions (3, n), in texels."""
    face, u, v = EFFECTS.function("cube_map", "face_and_uv")(direction.astype(float))
    return face, u * size, v * size


def texel_of(direction: NDArray[np.floating], size: int) -> NDArray[np.intp]:
    face, column, row = places(direction, size)
    i, j = (np.minimum(x.astype(np.intp), size - 1) for x in (row, column))
    return np.asarray((face * size + i) * size + j)


def density(product: ProductSampling, normal: NDArray[np.float32], direction: Array) -> Array:
    """Per solid angle, for unit directions (3, n): 4 / size^2 is a texel's area on the cube of half side 1."""
    texels = probabilities(product, normal)
    size = texels.shape[1]
    nearest = 1 / np.abs(direction).max(axis=0)
    return np.asarray(texels.ravel()[texel_of(direction, size)] * size**2 / 4 * nearest**3)


def draw(
    product: ProductSampling, normal: NDArray[np.float32], u: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    return product.sample(np.repeat(normal[:, None], u.shape[1], axis=1), u)


def below_chi_squared(observed: Array, expected: Array) -> bool:
    """Pearson's sum; neighbours are thrown together until they expect some twenty."""
    assert not observed[expected == 0].any()
    group = (np.cumsum(expected) / 20).astype(int)
    group = np.unique(group, return_inverse=True)[1]
    observed, expected = np.bincount(group, observed), np.bincount(group, expected)
    total = float(((observed - expected) ** 2 / np.maximum(expected, 1)).sum())
    degrees = len(expected) - 1
    assert degrees > 100
    spread = 2 / (9 * degrees)
    return total < degrees * (1 - spread + 4.75 * math.sqrt(spread)) ** 3


NORMAL_LIST = [unit(0, 1, 0), unit(-0.4, 0.2, 0.9), unit(0.1, -1, -0.3), unit(1, 1, -1)]
MAPS = {"sun": sun(), "waves": waves(), "few texels": waves(3)}

normals = pytest.mark.parametrize("normal", NORMAL_LIST, ids=str)
maps = pytest.mark.parametrize("faces", MAPS.values(), ids=MAPS.keys())


# ---------------------------------------------------------------- tables


def weights_of_all_kinds() -> Array:
    """Rows of 5: even, steep, with gaps, of one outcome, of none, of hardly possible ones."""
    return np.array(
        [
            [1, 1, 1, 1, 1],
            [1, 1e-3, 1e-6, 1e-9, 1e-30],
            [0, 2, 0, 3, 0],
            [0, 0, 0, 7, 0],
            [0, 0, 0, 0, 0],
            [1e-300, 1e-300, 1, 0, 1e-300],
            [1e40, 0, 0, 1e-40, 1e40],
        ]
    )


def test_probabilities_are_the_weights_and_nothing_possible_is_lost() -> None:
    weights = weights_of_all_kinds()
    edges = tabulated(weights).edges
    probability = np.diff(edges.astype(float))
    assert (edges[:, 0] == 0).all()
    assert (edges[:, -1] == 1).all()
    some = weights.sum(axis=1) > 0
    exact = weights[some] / weights[some].sum(axis=1, keepdims=True)
    # Each edge is rounded, and up to five units are kept for the possible outcomes.
    assert np.abs(probability[some] - exact).max() <= 6 * UNIT
    assert ((probability[some] >= UNIT) == (weights[some] > 0)).all()
    assert np.array_equal(probability[~some], [[0, 0, 0, 0, 1]])


@pytest.mark.parametrize("outcomes", [1, 2, 5, 16, 96])
def test_draws_invert_the_cumulative_sum_exactly(outcomes: int) -> None:
    rng = np.random.default_rng(outcomes)
    weights = rng.random((40, outcomes)) ** rng.integers(1, 60, (40, 1)) * rng.integers(
        0, 2, (40, outcomes)
    )
    if outcomes == 5:
        weights = np.concatenate((weights, weights_of_all_kinds()))
    tables = tabulated(weights)
    for number, edges in enumerate(tables.edges):
        # On every edge, just beside it, between, at both ends.
        u = np.concatenate((edges[:-1], edges - UNIT, edges + UNIT, rng.random(100, np.float32)))
        u = np.append(u, [0, LAST]).astype(np.float32)
        u = u[(u >= 0) & (u < 1)]
        outcome, rest, probability = tables.draw(np.full(len(u), number), u)
        exact = np.searchsorted(edges, u, side="right") - 1
        assert np.array_equal(outcome, exact)
        assert np.array_equal(probability, np.diff(edges)[exact])
        assert rest.dtype == probability.dtype == np.float32
        assert ((rest >= 0) & (rest < 1)).all()
        assert (probability > 0).all()
        between = edges.astype(float)[exact] + rest.astype(float) * probability
        assert np.abs(between - u).max() <= UNIT


def test_numbers_that_are_no_multiples_of_the_resolution_stay_inside() -> None:
    """What is left of a number after a draw is drawn with again, and may be anything below 1."""
    tables = tabulated(np.array([[1e-9, 1, 1e-9, 1], [3, 0, 0, 1e-12]]))
    u = np.float32(1) - np.float32(2) ** -np.arange(1, 25, dtype=np.float32)
    u = np.concatenate((u, 1 - u, np.float32(2) ** -np.arange(24, 149, 5, dtype=np.float32)))
    for table in (0, 1):
        _, rest, probability = tables.draw(np.full(len(u), table), u.astype(np.float32))
        assert ((rest >= 0) & (rest < 1)).all()
        assert (probability > 0).all()


# ---------------------------------------------------------------- density


@fewer
@maps
@normals
def test_weights_are_cosine_over_pi_times_density(
    faces: Faces, normal: NDArray[np.float32]
) -> None:
    product = drawn_by(faces)
    assert probabilities(product, normal).sum() == pytest.approx(1, abs=1e-6)
    u = np.random.default_rng(1).random((2, 20000), np.float32)
    direction, weight = draw(product, normal, u)
    assert direction.dtype == weight.dtype == np.float32
    size = probabilities(product, normal).shape[1]
    _, column, row = places(direction, size)
    # Rounding may carry directions within 1e-4 of a border into the next texel.
    inside = (np.abs(np.stack((column, row)) % 1 - 0.5) < 0.5 - 1e-4).all(axis=0)
    assert inside.mean() > 0.98
    d = direction[:, inside].astype(float)
    assert np.abs(np.linalg.norm(d, axis=0) - 1).max() < 3e-7
    cosine = normal.astype(float) @ d
    exact = cosine / (np.pi * density(product, normal, d))
    # The cosine's own rounding near the horizon beside the relative error of some ten operations.
    near = 3e-7 * np.abs(exact) / np.abs(cosine)
    assert (np.abs(weight[inside] - exact) <= 2e-6 * np.abs(exact) + near).all()


@fewer
@maps
@normals
def test_the_density_integrates_to_one_over_the_sphere(
    faces: Faces, normal: NDArray[np.float32]
) -> None:
    product = drawn_by(faces)
    size = probabilities(product, normal).shape[1]
    # Two by two points of Gauss in each texel, where the density is smooth.
    total = 0.0
    four = by_texel(2)[..., 0, :]
    right, down = four[:, 0, 1] - four[:, 0, 0], four[:, 1, 0] - four[:, 0, 0]
    for s in (-1, 1):
        for t in (-1, 1):
            aside = (s * right + t * down) / (size * math.sqrt(3))
            d = (by_texel(size)[..., 0, :] + aside[:, None, None]).reshape(-1, 3).T
            r = np.linalg.norm(d, axis=0)
            total += float((density(product, normal, d / r) / r**3).sum()) / size**2
    assert total == pytest.approx(1, abs=1e-6)


@fewer
@maps
@normals
def test_directions_are_drawn_with_that_density(faces: Faces, normal: NDArray[np.float32]) -> None:
    product = drawn_by(faces)
    count = 2**20
    u = np.random.default_rng(2).random((2, count), np.float32)
    direction, _ = draw(product, normal, u)
    expected = probabilities(product, normal) * count
    size = expected.shape[1]
    drawn = np.bincount(texel_of(direction, size), minlength=expected.size)
    assert below_chi_squared(drawn, expected.ravel())
    # And evenly within the texels: sixteenths of them, all texels together.
    _, column, row = places(direction, size)
    part = (row % 1 * 16).astype(int) * 16 + (column % 1 * 16).astype(int)
    assert below_chi_squared(np.bincount(part, minlength=256), np.full(256, count / 256))


@fewer
@pytest.mark.parametrize("seamless", [True, False])
@pytest.mark.parametrize("size", [1, 2, 3, 7, 16, 40, 300])
def test_no_direction_with_light_has_density_zero(size: int, seamless: bool) -> None:
    """One bright texel in the dark: at corners, at edges, inside."""
    rng = np.random.default_rng(size)
    last = size - 1
    spots = {(0, 0), (last, last), (0, last // 2), (last, last // 3), (last // 2, last // 2)}
    for face, (row, column) in zip(rng.permuted(np.arange(60) % 6), spots, strict=False):
        faces = np.zeros((6, size, size, 3), np.float32)
        faces[face, row, column, rng.integers(3)] = 1
        product = product_sampling(faces, seamless)
        if product is None:
            assert size == 1, "a texel in six is wide"
            continue
        # Directions all about the texel, on whatever faces they are.
        centre = by_texel(size)[face, row, column, 0]
        d = centre[:, None] / np.linalg.norm(centre) + rng.normal(size=(3, 4000)) * 1.5 / size
        d = (d / np.linalg.norm(d, axis=0)).astype(np.float32)
        bright = np.flatnonzero(LOOKUPS[seamless](faces, d).max(axis=0) > 0)
        assert len(bright) > 100
        for k in bright[:: len(bright) // 10]:
            # A normal from which this direction is above the horizon, if only just.
            beside = np.cross(d[:, k], rng.normal(size=3))
            normal = unit(*(beside / np.linalg.norm(beside) + 10 ** rng.uniform(-5, 1) * d[:, k]))
            # Directions on a border of the tables' texels belong to either side.
            around = d[:, k : k + 1] * (1 + np.zeros(1))
            assert density(product, normal, around)[0] > 0


def test_nothing_just_above_the_horizon_has_density_zero() -> None:
    """Whatever the table's normal is: each serves all normals near it."""
    product = drawn_by(waves() + np.float32(0.01))
    rng = np.random.default_rng(12)
    normal = unit_columns(rng.normal(size=(3, 200000)))
    beside = np.cross(normal, rng.normal(size=normal.shape), axis=0)
    beside /= np.linalg.norm(beside, axis=0)
    d = beside + 10 ** rng.uniform(-5, -1, normal.shape[1]) * normal
    table, cell = nearest_normal(normal), texel_of(d, CELLS)
    rows = np.diff(product.rows.edges)
    columns = np.diff(product.columns.edges).reshape(len(rows), 6 * CELLS, CELLS)
    assert (rows[table, cell // CELLS] > 0).all()
    assert (columns[table, cell // CELLS, cell % CELLS] > 0).all()


@pytest.mark.parametrize("seamless", [True, False])
def test_what_is_dark_is_never_drawn(seamless: bool) -> None:
    faces = np.zeros((6, 64, 64, 3), np.float32)
    faces[4, 20:24, 30:33] = 1
    product = drawn_by(faces, seamless)
    u = np.random.default_rng(3).random((2, 10000), np.float32)
    direction, weight = draw(product, unit(0.2, 0.3, 1), u)
    face, column, row = places(direction, 64)
    # The bilinear interpolation reaches half a texel further, the tables' texels up to one.
    assert (face == 4).all()
    assert ((column > 29 - 1e-4) & (column < 34 + 1e-4)).all()
    assert ((row > 19 - 1e-4) & (row < 25 + 1e-4)).all()
    assert (weight > 0).all()


def test_under_a_dark_half_of_the_sky_nothing_counts() -> None:
    faces = np.zeros((6, 8, 8, 3), np.float32)
    faces[2, 2:6, 2:6] = 1
    product = drawn_by(faces)
    u = np.random.default_rng(4).random((2, 1000), np.float32)
    direction, weight = draw(product, unit(0, -1, 0), u)
    light = LOOKUPS[True](faces, direction).max(axis=0)
    assert np.isfinite(weight).all()
    assert not (light * np.maximum(weight, 0)).any()


@pytest.mark.parametrize("row", [64, 72])
@pytest.mark.parametrize("radiance", [4e5, 4e6])
def test_a_third_of_the_samples_looks_at_the_sky_beside_the_sun(row: int, radiance: float) -> None:
    """However bright the sun is, for where it is hidden; on a border of cells and within one."""
    product = drawn_by(sun(radiance=radiance, row=row))
    for normal in (unit(0, 1, 0), unit(0.3, 1, -0.2), unit(-0.5, 0.5, -0.7)):
        texels = probabilities(product, normal)
        beside = 1 - texels[2, row - 1 : row + 2, 84:87].sum() / texels.sum()
        # The corner of the interpolated sun may lie in a cell that is not large.
        assert 0.27 < beside < 0.34


def test_light_that_is_alone_gets_all_samples() -> None:
    faces = np.zeros((6, 64, 64, 3), np.float32)
    faces[4, 30, 30] = 1
    cells = probabilities(drawn_by(faces), unit(0.1, 0.2, 1)).reshape(6, 16, 4, 16, 4)
    cells = cells.sum(axis=(2, 4))
    assert cells.sum() == pytest.approx(1, abs=1e-6)
    assert (cells > 0).sum() == 1


# ---------------------------------------------------------------- expectation and variance


def by_quadrature(faces: Faces, normals: Array, size: int) -> tuple[Array, Array]:
    """Means (3, k) of the radiance and its square over the cosine's density, for unit normals (3, k), in float64.

    In the middles of size x size squares of each face.
    """
    d = by_texel(size).reshape(-1, 3).T
    r = np.linalg.norm(d, axis=0)
    light = LOOKUPS[True](faces, d)
    both = np.concatenate((light, light**2)) * (4 / size**2 / np.pi / r**4)
    means = np.stack([both @ np.maximum(n @ d, 0) for n in normals.T.astype(float)], axis=1)
    return means[:3], means[3:]


def estimates(faces: Faces, normal: NDArray[np.float32], u: NDArray[np.float32]) -> Array:
    """(3, n) by the tables."""
    direction, weight = draw(drawn_by(faces), normal, u)
    return np.asarray(LOOKUPS[True](faces, direction).astype(float) * np.maximum(weight, 0))


def by_cosine(faces: Faces, normal: NDArray[np.float32], u: NDArray[np.float32]) -> Array:
    """(3, n) by the density of the cosine."""
    directions = cosine_directions(np.repeat(normal[:, None], u.shape[1], axis=1), u)
    return LOOKUPS[True](faces, directions).astype(float)


@fewer
@normals
@pytest.mark.parametrize("faces", [waves(), waves(3), sun(32, 600)], ids=["waves", "3", "sun"])
def test_the_mean_is_the_irradiance_over_pi(faces: Faces, normal: NDArray[np.float32]) -> None:
    count = 2**18
    u = np.random.default_rng(5).random((2, count), np.float32)
    found = estimates(faces, normal, u)
    exact = by_quadrature(faces, normal[:, None], 8 * faces.shape[1])[0][:, 0]
    error = found.std(axis=1) / math.sqrt(count)
    # Beside the statistical error that of quadrature, second order in an eighth of a texel.
    assert (np.abs(found.mean(axis=1) - exact) < 4.9 * error + 1e-4 * exact).all()
    assert (error < 0.002 * exact).all(), "the estimate is worth something"
    # The cosine alone says the same, if less clearly.
    other = by_cosine(faces, normal, u[::-1])
    both = np.hypot(error, other.std(axis=1) / math.sqrt(count))
    assert (np.abs(found.mean(axis=1) - other.mean(axis=1)) < 4.9 * both).all()


def picture(name: str) -> Faces:
    if name.endswith(".png"):
        return cube_from_cross(read_picture(PICTURES / name))
    image = read_picture(PICTURES / name)
    return cube_from_lat_long(image, image.shape[0] // 2)


@pytest.mark.parametrize(
    ("name", "times"), [("sun", 3000), ("studio.exr", 50), ("sky.exr", 9), ("valley.png", 1.75)]
)
def test_variance_is_reduced(name: str, times: float) -> None:
    """Eight normals together, without strata; at least one and a half of the factors given was measured."""
    faces = sun() if name == "sun" else picture(name)
    rng = np.random.default_rng(6)
    normal = unit_columns(rng.normal(size=(3, 8)))
    # Middles of quarters of the sun's texel: the mean square of the pyramid is 0.44 of its top, this says 0.32.
    mean, square = by_quadrature(faces, normal, 512 if name == "sun" else 128)
    u = rng.random((8, 2, 2**15), np.float32)
    mine = sum(estimates(faces, n, v).var(axis=1).sum() for n, v in zip(normal.T, u, strict=True))
    assert mine * times < (square - mean**2).sum()


def unit_columns(vectors: Array) -> NDArray[np.float32]:
    return (vectors / np.linalg.norm(vectors, axis=0)).astype(np.float32)


@pytest.mark.parametrize("name", ["studio.exr", "sky.exr", "valley.png"])
def test_sixteen_stratified_samples_err_less_too(name: str) -> None:
    """Stratification helps the cosine more than the tables; the squared error is less than half even so."""
    faces = picture(name)
    samples, count = 16, 300
    normal = unit_columns(np.random.default_rng(7).normal(size=(3, count)))
    exact, _ = by_quadrature(faces, normal, 64)
    u = SobolSampler(8).draw(Block(np.arange(count, dtype=np.uint32), 0, samples, 0), 2, 2)
    long = np.repeat(normal, samples, axis=1)
    direction, weight = drawn_by(faces).sample(long, u)
    squared = []
    for found in (
        LOOKUPS[True](faces, direction) * np.maximum(weight, 0),
        LOOKUPS[True](faces, cosine_directions(long, u)),
    ):
        means = found.reshape(3, count, samples).mean(axis=2)
        squared.append(float(((means - exact) ** 2).mean()))
    assert squared[0] < 0.5 * squared[1]


def test_stratified_numbers_draw_stratified_rows() -> None:
    """Of 2^m points of a (0, 2)-sequence, an interval gets its share but for less than 2."""
    product = drawn_by(waves())
    normal = NORMAL_LIST[1]
    count = 1024
    u = SobolSampler(9).draw(Block(np.zeros(1, np.uint32), 0, count, 0), 2, 2)
    direction, _ = draw(product, normal, u)
    texels = probabilities(product, normal)
    size = texels.shape[1]
    rows = texels.sum(axis=2).reshape(6 * CELLS, -1).sum(axis=1)
    drawn = np.bincount(texel_of(direction, size) // (size * size // CELLS), minlength=6 * CELLS)
    assert np.abs(drawn - rows * count).max() < 2


# ---------------------------------------------------------------- when it pays


def test_even_skies_keep_the_cosine() -> None:
    d = by_texel(32)[..., 0, :]
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    for value in (np.ones(d.shape[:3]), 1 + 0.5 * d[..., 1], 1e-12 + 0 * d[..., 0]):
        faces = (value[..., None] * (0.3, 0.6, 1.0)).astype(np.float32)
        assert product_sampling(faces, True) is None


def test_uneven_skies_get_tables() -> None:
    for faces in (sun(), waves(), picture("sky.exr"), picture("studio.exr"), picture("valley.png")):
        assert product_sampling(faces, True) is not None


def test_stars_are_fine_enough_to_be_uneven() -> None:
    """As much light in every cell, but in few of its texels."""
    faces = np.zeros((6, 128, 128, 3), np.float32)
    faces[:, 3::8, 5::8] = 1
    product = drawn_by(faces)
    assert product.texel_rows.edges.shape[1] - 1 == 8, "the texels are as small as the stars"


# ---------------------------------------------------------------- numbers


def test_extremes_stay_finite() -> None:
    """All ends of the numbers, normals on every border, light from 1e-30 to 1e20."""
    faces = np.full((6, 32, 32, 3), 1e-30, np.float32)
    faces[0, 0, 0] = 1e20
    faces[3, 31, 0] = 1e-10
    faces[5, 16:] = 0
    product = drawn_by(faces)
    ends = np.array([0, UNIT, 2 * UNIT, 0.5 - UNIT, 0.5, 0.5 + UNIT, 1 - 2 * UNIT, LAST])
    random = np.random.default_rng(10).random(200)
    u = np.stack([x.ravel() for x in np.meshgrid(np.append(ends, random), ends)])
    u = np.concatenate((u, u[::-1]), axis=1).astype(np.float32)
    grid = np.linspace(-1, 1, 5)
    every = np.stack([x.ravel() for x in np.meshgrid(grid, grid, grid)])
    squared = np.linalg.norm(every, axis=0)
    every = np.concatenate((every[:, squared > 0] / squared[squared > 0], -0.0 * every[:, :1]), 1)
    for normal in every.T.astype(np.float32):
        direction, weight = draw(product, normal, u)
        assert np.abs(np.linalg.norm(direction, axis=0) - 1).max() < 3e-7
        assert np.isfinite(weight).all()
        light = LOOKUPS[True](faces, direction) * np.maximum(weight, 0)
        assert np.isfinite(light).all()


def test_every_normal_has_its_table() -> None:
    """Neighbours in the table are neighbours in space: its width is that of a square of the octahedron."""
    rng = np.random.default_rng(11)
    normal = rng.normal(size=(3, 200000)).astype(np.float32)
    normal /= np.linalg.norm(normal, axis=0)
    normal[:, :6] = np.concatenate((np.eye(3), -np.eye(3)), axis=1)
    number = nearest_normal(normal)
    assert number.min() >= 0
    assert number.max() < NORMALS**2
    count = np.bincount(number, minlength=NORMALS**2)
    assert (count > 0).all()
    mean = np.stack([np.bincount(number, x, NORMALS**2) for x in normal.astype(float)]) / count
    mean /= np.linalg.norm(mean, axis=0)
    away = np.arccos(np.clip((mean[:, number] * normal).sum(axis=0), -1, 1))
    # The square's half diagonal is sqrt(2) / NORMALS; lifted to the octahedron it is at most sqrt(3) times as long,
    # and that is seen from at least 1 / sqrt(3) away. The mean is no further from anything than twice that.
    assert away.max() < 2 * 3 * math.sqrt(2) / NORMALS
