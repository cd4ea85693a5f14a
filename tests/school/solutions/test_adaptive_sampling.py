"""Adaptive sampling: cells and their neighbours fit together to the last bit."""

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, Array

subdivide = SOLUTIONS.function("adaptive_sampling", "subdivide")

dtypes = pytest.mark.parametrize("dtype", DTYPES)


def cells_of(n: int, dtype: type) -> tuple[Array, Array, Array, Array]:
    """Cells of all sizes, far from the origin as well."""
    rng = np.random.default_rng(4)
    x0, y0 = rng.uniform(-1000, 1000, (2, n))
    width, height = 10.0 ** rng.uniform(-6, 3, (2, n))
    return tuple(v.astype(dtype) for v in (x0, y0, x0 + width, y0 + height))  # type: ignore[return-value]


@dtypes
def test_neighbours_share_the_middle_of_their_common_side(dtype: type) -> None:
    x0, y0, x1, y1 = cells_of(1000, dtype)
    right = subdivide(x1, y0, x1 + dtype(1), y1)
    left = subdivide(x0, y0, x1, y1)
    assert (left[2][1] == right[0][0]).all()
    assert (left[3][1] == right[3][0]).all()


def test_five_generations_still_cover_the_pixel_exactly() -> None:
    cells = tuple(np.array([v], np.float32) for v in (3, 5, 4, 6))
    for _ in range(5):
        cells = tuple(edge.ravel() for edge in subdivide(*cells))
    x0, y0, x1, y1 = cells
    assert x0.size == 4**5
    assert ((x1 - x0) * (y1 - y0)).sum() == 1
    # 33 x 33 corners in all, each of them a ray that up to four cells share.
    corners = {*zip(x0, y0, strict=True), *zip(x1, y0, strict=True)}
    corners |= {*zip(x0, y1, strict=True), *zip(x1, y1, strict=True)}
    assert len(corners) == 33**2
