"""Compiled loops look up cube maps, and draw directions towards their light, with the same bits."""

import numpy as np
import pytest

from course.compiled import library
from course.core.environment import ConstantEnvironment, CubeEnvironment
from course.core.types import Floats32
from course.effects import Bound, Effects
from course.extras.environment_sampling import ProductSampling, product_sampling
from course.extras.surface import build_surface

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.compiled.environment import CompiledCubeEnvironment, compiled_environment
from course.compiled.stages import CompiledSky


def drawn_by(size: int) -> ProductSampling:
    """A sky whose brightness differs by a factor of a million, with a black face."""
    rng = np.random.default_rng(size)
    faces = np.exp(rng.uniform(-7, 7, (6, size, size, 3))).astype(np.float32)
    faces[3] = 0
    product = product_sampling(faces, seamless=True)
    assert product is not None
    return product


def by_loop(product: ProductSampling) -> CompiledSky:
    """A compiled sky with these directions over nothing at all."""
    none, black = np.zeros(0, np.bool_), ConstantEnvironment(np.zeros(3, np.float32))
    return CompiledSky(build_surface([]), black, product, none, none)


def normals(n: int) -> Floats32:
    """Of all directions, along all axes and diagonals, and one that has cancelled to nothing."""
    rng = np.random.default_rng(5)
    some = rng.normal(size=(3, n))
    grid = np.stack(np.meshgrid(*[[-1.0, -0.0, 1.0]] * 3)).reshape(3, -1)
    some[:, : grid.shape[1]] = grid
    length = np.linalg.norm(some, axis=0)
    return (some / np.where(length > 0, length, 1)).astype(np.float32)


# With 16 texels a cell is a texel; with 64 it is divided.
@pytest.mark.parametrize("size", [16, 64])
def test_directions_and_weights(size: int) -> None:
    product = drawn_by(size)
    n = 20_000
    u = np.random.default_rng(6).random((2, n), np.float32)
    u[:, -4:] = [[0, 0, 1 - 2.0**-24, 1 - 2.0**-24], [0, 1 - 2.0**-24, 0, 1 - 2.0**-24]]
    for columns in (slice(None), slice(0, 0), slice(None, None, 3)):
        some, numbers = normals(n)[:, columns], u[:, columns]
        passes, loop = product.sample(some, numbers), by_loop(product).directions(some, numbers)
        for mine, theirs in zip(passes, loop, strict=True):
            assert (mine.shape, mine.dtype) == (theirs.shape, theirs.dtype)
            assert mine.tobytes() == theirs.tobytes()
    direction, weight = by_loop(product).directions(normals(n), u)
    assert len(np.unique(direction.round(2), axis=1).T) > 1000
    assert (weight > 0).mean() > 0.9


def looked_up_by(folder: str | None, size: int, seamless: bool) -> CubeEnvironment:
    faces = np.random.default_rng(size).random((6, size, size, 3), np.float32)
    names = "lookup", "lookup_seamless"
    functions = Bound(Effects(folder)).functions("cube_map", *names, asked_by=())
    return CubeEnvironment(faces, functions, seamless)


@pytest.mark.parametrize("seamless", [False, True])
@pytest.mark.parametrize("size", [1, 2, 3, 16, 100])
def test_cube_maps_are_looked_up(size: int, seamless: bool) -> None:
    passes = looked_up_by(None, size, seamless)
    loop = compiled_environment(passes)
    assert isinstance(loop, CompiledCubeEnvironment)
    # Along the axes and diagonals, next to the edges of faces, and all over.
    direction = normals(20_000)[:, 27:]
    direction[:, :5000] *= np.array([[1.0], [0.01], [1.0]], np.float32)
    direction[0, :2500] = np.abs(direction[2, :2500])
    for columns in (slice(None), slice(0, 0), slice(None, None, 3)):
        mine, theirs = (each.radiance(direction[:, columns]) for each in (passes, loop))
        assert (mine.shape, mine.dtype) == (theirs.shape, theirs.dtype)
        assert mine.tobytes() == theirs.tobytes()


def test_functions_of_other_folders_are_called() -> None:
    """A student's function has no twin."""
    environment = looked_up_by("assignments", 4, seamless=True)
    assert compiled_environment(environment) is environment
