"""Laws of affine transforms and of what they do to a mesh."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from course.engine import shapes
from course.engine.formats.meshes.transforms import (
    SHORTEST,
    apply,
    compose,
    rotate,
    scale,
    translate,
)
from course.engine.shapes.mesh import Mesh

TILTED = compose(
    [scale((2.0, 0.5, 3.0)), rotate((1.0, 2.0, 3.0), 40.0), translate((5.0, -6.0, 7.0))]
)
MIRRORED = compose([scale((-1.0, 2.0, 0.3)), rotate((0.0, 1.0, 1.0), 100.0)])


def moved(matrix: NDArray[np.float64], point: tuple[float, float, float]) -> list[float]:
    return list((matrix @ [*point, 1.0])[:3])


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def volume(mesh: Mesh) -> float:
    p0, p1, p2 = mesh.vertices[mesh.triangles].transpose(1, 0, 2)
    return float(np.sum(p0 * np.cross(p1, p2)) / 6.0)


def test_each_kind_moves_a_point_as_it_says() -> None:
    assert moved(translate((1.0, 2.0, 3.0)), (1.0, 1.0, 1.0)) == [2.0, 3.0, 4.0]
    assert moved(scale(2.0), (1.0, 2.0, 3.0)) == [2.0, 4.0, 6.0]
    assert moved(scale((2.0, -1.0, 0.5)), (1.0, 2.0, 3.0)) == [2.0, -2.0, 1.5]


@pytest.mark.parametrize(
    ("axis", "point", "image"),
    [
        ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), [0.0, 0.0, 1.0]),
        ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), [1.0, 0.0, 0.0]),
        ((0.0, 0.0, 7.0), (1.0, 0.0, 0.0), [0.0, 1.0, 0.0]),
    ],
)
def test_quarter_turn_is_exact_and_counter_clockwise(
    axis: tuple[float, float, float], point: tuple[float, float, float], image: list[float]
) -> None:
    for degrees in (90.0, -270.0, 450.0):
        assert moved(rotate(axis, degrees), point) == image
    assert moved(rotate(axis, -90.0), point) == [-x for x in image]
    np.testing.assert_array_equal(rotate(axis, 720.0), np.eye(4))


@given(
    axis=st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: max(map(abs, v)) > 1e-3),
    degrees=st.floats(-1000.0, 1000.0),
    size=st.sampled_from([1e-200, 1.0, 1e200]),
)
def test_rotation_is_rigid_keeps_its_axis_and_turns_by_its_angle(
    axis: tuple[float, float, float], degrees: float, size: float
) -> None:
    matrix = rotate(np.array(axis) * size, degrees)[:3, :3]
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), rtol=0.0, atol=1e-14)
    assert np.linalg.det(matrix) == pytest.approx(1.0, abs=1e-14)
    np.testing.assert_allclose(matrix @ axis, axis, rtol=0.0, atol=1e-14)
    assert np.trace(matrix) == pytest.approx(1.0 + 2.0 * math.cos(math.radians(degrees)), abs=1e-12)


def test_compose_applies_the_first_first() -> None:
    moves = [translate((1.0, 0.0, 0.0)), scale(2.0), rotate((0.0, 0.0, 1.0), 90.0)]
    assert moved(compose(moves), (0.0, 0.0, 0.0)) == [0.0, 2.0, 0.0]
    np.testing.assert_array_equal(compose([]), np.eye(4))


@pytest.mark.parametrize("matrix", [TILTED, MIRRORED], ids=["tilted", "mirrored"])
def test_volume_scales_by_the_determinant_and_stays_positive(matrix: NDArray[np.float64]) -> None:
    mesh = shapes.torus(segments=12, sides=7)
    image = apply(mesh, matrix)
    factor = abs(np.linalg.det(matrix[:3, :3]))
    assert volume(image) == pytest.approx(volume(mesh) * factor, rel=1e-12)


@pytest.mark.parametrize("matrix", [TILTED, MIRRORED], ids=["tilted", "mirrored"])
def test_normals_stay_orthogonal_to_their_faces(matrix: NDArray[np.float64]) -> None:
    image = apply(shapes.box((1.0, 2.0, 3.0)), matrix)
    assert image.normals is not None
    p0, p1, p2 = image.vertices[image.triangles].transpose(1, 0, 2)
    faces = np.cross(p1 - p0, p2 - p0)
    faces /= np.linalg.norm(faces, axis=1, keepdims=True)
    normals = unit(image.normals)[image.triangles[:, 0]]
    np.testing.assert_allclose(normals, faces, rtol=0.0, atol=1e-14)


def test_ellipsoid_normals_are_its_gradient() -> None:
    """In length too, in units of the largest possible one: 1 / 0.25."""
    image = apply(shapes.sphere(1.0, 24), scale((1.0, 2.0, 0.25)))
    gradient = image.vertices / np.array([1.0, 2.0, 0.25]) ** 2
    np.testing.assert_allclose(image.normals, gradient / 4, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("matrix", [TILTED, MIRRORED], ids=["tilted", "mirrored"])
@pytest.mark.parametrize("before", [np.eye(4), scale((1.0, 0.2, 3.0))], ids=["unit", "stretched"])
def test_image_of_a_mixture_of_normals_is_the_mixture_of_their_images(
    matrix: NDArray[np.float64], before: NDArray[np.float64]
) -> None:
    mesh = apply(shapes.torus(segments=12, sides=7), before)
    image = apply(mesh, matrix)
    assert mesh.normals is not None
    assert image.normals is not None
    weights = np.random.default_rng(3).dirichlet((1.0, 1.0, 1.0), len(mesh.triangles))[:, :, None]
    mixed = np.sum(mesh.normals[mesh.triangles] * weights, axis=1)
    # A mirror turns the triangles round, and with them the order of their corners.
    turned = weights if np.linalg.det(matrix[:3, :3]) > 0.0 else weights[:, ::-1]
    got = np.sum(image.normals[image.triangles] * turned, axis=1)
    expected = mixed @ np.linalg.inv(matrix[:3, :3])
    np.testing.assert_allclose(unit(got), unit(expected), rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("factor", [-2.0, 1.0, 1e-9, 1e30])
def test_without_uneven_scaling_normals_stay_unit(factor: float) -> None:
    mesh = shapes.torus(segments=12, sides=7)
    image = apply(mesh, compose([scale(factor), rotate((1.0, 2.0, 3.0), 40.0)]))
    assert image.normals is not None
    np.testing.assert_allclose(np.linalg.norm(image.normals, axis=1), 1.0, rtol=0.0, atol=4e-16)


def test_image_of_a_vertex_has_the_same_bits_wherever_it_stands() -> None:
    """Among many others or alone: otherwise the copies of a vertex along a seam would part."""
    # Off centre, so that arithmetic about the middle of the mesh would show.
    mesh = apply(shapes.cylinder(0.3, 0.7, 13), translate((0.7, 0.2, 0.3)))
    image = apply(mesh, TILTED)
    assert mesh.normals is not None
    assert image.normals is not None
    for k in range(len(mesh.vertices)):
        alone = apply(Mesh(mesh.vertices[[k]], np.zeros((1, 3), int), mesh.normals[[k]]), TILTED)
        np.testing.assert_array_equal(alone.vertices[0], image.vertices[k])
        np.testing.assert_array_equal(alone.normals, image.normals[[k]])
    assert len(np.unique(image.vertices + 0.0, axis=0)) == 2 * 13 + 2


@pytest.mark.parametrize("factor", [1e-140, 1e140])
def test_extreme_scales_keep_normals_within_range(factor: float) -> None:
    mesh = shapes.sphere(1.0, 8)
    image = apply(mesh, scale(factor))
    np.testing.assert_allclose(image.normals, mesh.normals, rtol=0.0, atol=1e-15)
    uneven = apply(apply(mesh, scale((1.0, factor, 1.0))), scale((1.0, 1.0, factor)))
    assert uneven.normals is not None
    lengths = np.linalg.norm(uneven.normals, axis=1)
    assert lengths.min() >= 0.999 * SHORTEST
    assert lengths.max() < 1.0 + 1e-12


def test_flat_mesh_stays_without_normals_and_uv_is_kept() -> None:
    quad = shapes.quad()
    image = apply(Mesh(quad.vertices, quad.triangles, None, quad.uv), TILTED)
    assert image.normals is None
    assert image.uv is quad.uv


def test_mesh_given_is_left_as_it_was() -> None:
    mesh = shapes.sphere(1.0, 8)
    assert mesh.normals is not None
    for array in (mesh.vertices, mesh.triangles, mesh.normals):
        array.setflags(write=False)
    apply(mesh, MIRRORED)


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.eye(3), r"shape \(3, 3\)"),
        (np.diag([1.0, 1.0, 1.0, 2.0]), "matrix ends in"),
        (np.diag([1.0, 0.0, 1.0, 1.0]), "can't be inverted"),
        (np.diag([1.0, math.nan, 1.0, 1.0]), "not finite"),
        (translate((1.7e308, 0.0, 0.0)) @ scale(1.7e308), "out of the range"),
    ],
)
def test_bad_matrices_are_refused(matrix: NDArray[np.float64], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        apply(shapes.quad(4.0, 4.0), matrix)
