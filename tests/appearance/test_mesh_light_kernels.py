"""The compiled loop draws the same points on lights of triangles, bit for bit."""

import numpy as np
import pytest

from course import shapes
from course.compiled import library
from course.core.lights.sample import towards
from course.shapes.mesh import Mesh
from tests.appearance.mesh_lamps import BALL, KNOT, around, lamp, moved, without

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled.direct import on_triangles

LAMPS = {
    "one triangle": without(shapes.quad(), 1),
    "a quad": shapes.quad(),
    "a box": shapes.box(),
    "a ball": BALL,
    "a ball turned inside out": moved(BALL, 1, turned=True),
    "a knot": KNOT,
    "a speck": moved(KNOT, 1e-9),
    "triangles that are alike": Mesh(np.eye(3), np.array([[0, 1, 2]] * 5)),
}


@pytest.mark.parametrize("name", LAMPS)
def test_the_same_samples(name: str) -> None:
    light, n = lamp(LAMPS[name]), 20_000
    rng = np.random.default_rng(1)
    points = around(n, 1, 2) * rng.uniform(0, 1, n).astype(np.float32)
    # On corners of the light, and in the planes of a quad and of the sides of a box.
    corners = light.planes[:300, :3].T
    points[:, : corners.shape[1]] = corners
    points[1, 300:400] = 0
    points[1, 400:500] = 0.5
    points[:, 1000:1100] = 0
    points[1, 1000:1100] = 0.7
    u = rng.random((3, n), np.float32)
    u[:, 500:1000] = rng.choice(np.array([0, 1 - 2.0**-24], np.float32), (3, 500))
    # Where one of two halves of a quad ends and the other begins.
    u[0, 1000:1100] = 0.5
    for columns in (slice(None), slice(0, 0), slice(None, None, 3)):
        some, numbers = points[:, columns], u[:, columns]
        passes, loop = light.sample(some, numbers, towards), on_triangles(light, some, numbers)
        for mine, theirs in zip(vars(passes).values(), vars(loop).values(), strict=True):
            assert (mine.shape, mine.dtype) == (theirs.shape, theirs.dtype)
            assert mine.tobytes() == theirs.tobytes()
    sample = on_triangles(light, points, u)
    assert np.isfinite(sample.factor).all()
    assert sample.factor.any()
