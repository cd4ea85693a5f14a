"""Affine transforms: (4, 4) float64 matrices that act on columns (x, y, z, 1)."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from course.shapes.mesh import Mesh

Matrix = NDArray[np.float64]

ROUNDING = 1e-12
"""Lengths of transformed normals within this of 1 are 1."""

SHORTEST = 1e-100
"""Transformed normals are at least this long: their squares are still numbers of float64."""


def translate(offset: ArrayLike) -> Matrix:
    """Return the matrix that moves by `offset` (3,) [m]."""
    matrix = np.eye(4)
    matrix[:3, 3] = offset
    return matrix


def scale(factor: float | Sequence[float] | NDArray[np.float64]) -> Matrix:
    """Return the matrix that scales about the origin, by one factor or by three; negative ones mirror."""
    return np.diag([*np.broadcast_to(factor, 3), 1.0])


def rotate(axis: ArrayLike, degrees: float) -> Matrix:
    """Return the matrix that turns about `axis` (3,) through the origin.

    Positive angles turn counter-clockwise as seen from the axis' tip (Rodrigues' formula). Quarter
    turns about a coordinate axis are exact.
    """
    vector = np.asarray(axis, np.float64)
    # Scaled first: the square of a tiny or huge axis would leave float64's range.
    vector = vector / np.max(np.abs(vector))
    x, y, z = vector / math.sqrt(float(np.sum(vector * vector)))
    cosine, sine = _cosine_sine(degrees)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    outer = np.outer([x, y, z], [x, y, z])
    matrix = np.eye(4)
    matrix[:3, :3] = cosine * np.eye(3) + sine * cross + (1.0 - cosine) * outer
    return matrix


def of_step(step: Mapping[str, Any]) -> Matrix:
    """Return the matrix of a step of ``transform``, as scene files write it: ``{"translate": [0, 1, 0]}``."""
    match step:
        case {"translate": offset}:
            return translate(offset)
        case {"scale": factors}:
            return scale(factors)
        case {"rotate": {"axis": axis, "degrees": degrees}}:
            return rotate(axis, degrees)
    return np.array(step["matrix"], np.float64)


def compose(matrices: Iterable[Matrix]) -> Matrix:
    """Return the one matrix that applies `matrices` in order, the first of them first."""
    product = np.eye(4)
    for matrix in matrices:
        product = matrix @ product
    return product


def apply(mesh: Mesh, matrix: Matrix) -> Mesh:
    """Return `mesh` transformed: normals by the inverse transpose, winding kept outwards.

    Vertices with the same bits keep the same bits, so that a watertight mesh stays so.

    The transform of a mixture of normals is the mixture of their transforms, if these keep their lengths. So
    they do, but for one factor for all of them: the longest possible has length 1, and under rotations and even
    scales unit normals stay unit normals. Whoever interpolates them sees the normals of the mesh as it was,
    interpolated and then transformed.
    Raises ValueError for a matrix that is not affine, not finite or not invertible, and where a coordinate overflows.

    Parameters
    ----------
    mesh : Mesh
    matrix : (4, 4) float64, affine and invertible
    """
    matrix = np.asarray(matrix, np.float64)
    if matrix.shape != (4, 4):
        raise ValueError(f"matrix has shape {matrix.shape}: expected (4, 4)")
    if not np.all(np.isfinite(matrix)):
        raise ValueError("matrix holds a number that is not finite")
    if not np.array_equal(matrix[3], [0.0, 0.0, 0.0, 1.0]):
        raise ValueError(f"matrix ends in {matrix[3].tolist()}: expected [0, 0, 0, 1]")
    linear = matrix[:3, :3]
    sign = np.linalg.slogdet(linear).sign
    if sign == 0.0:
        raise ValueError("matrix can't be inverted: it flattens the mesh")

    with np.errstate(over="ignore", invalid="ignore"):
        vertices = _rows_times(mesh.vertices, linear.T) + matrix[:3, 3]
    if not np.all(np.isfinite(vertices)):
        raise ValueError("matrix moves a vertex out of the range of float64")
    normals = None if mesh.normals is None else _transformed_normals(mesh.normals, linear)
    triangles = mesh.triangles if sign > 0.0 else np.ascontiguousarray(mesh.triangles[:, ::-1])
    return Mesh(vertices, triangles, normals, mesh.uv)


def _transformed_normals(normals: NDArray[np.float64], linear: Matrix) -> NDArray[np.float64]:
    # The inverse transpose has the direction of the matrix of cofactors, and its sign keeps outward
    # normals outward under a mirror. One factor for all normals is free.
    scaled = linear / np.max(np.abs(linear))
    inverse = np.linalg.inv(scaled)
    if not np.all(np.isfinite(inverse)):
        raise ValueError("matrix can't be inverted: it flattens the mesh")
    inverse /= np.max(np.abs(inverse))
    turned = _rows_times(normals, inverse)
    largest = _largest(turned)
    turned = turned / np.where(largest > 0.0, largest, 1.0)
    x, y, z = _columns(turned * turned)
    lengths = np.sqrt(x + y + z)
    unit = turned / np.where(lengths > 0.0, lengths, 1.0)
    # By its largest singular value, the longest that the image of a unit vector can be.
    lengths = lengths * (largest / np.linalg.norm(inverse, 2))
    # Where nothing is stretched unevenly, unit vectors stay just that.
    lengths = np.where(np.abs(lengths - 1.0) < ROUNDING, 1.0, np.maximum(lengths, SHORTEST))
    # A scale so uneven that a normal underflows leaves the original direction, which hardly counts.
    before = normals / np.maximum(_largest(normals), SHORTEST)
    return np.where(largest > 0.0, unit, before) * lengths


def _rows_times(rows: NDArray[np.float64], matrix: Matrix) -> NDArray[np.float64]:
    """Return rows @ matrix by products and sums of columns.

    A BLAS may round a row differently depending on where in the array it stands, and two copies of
    one vertex would part.
    """
    x, y, z = _columns(rows)
    return np.asarray(x * matrix[0] + y * matrix[1] + z * matrix[2])


def _largest(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """The largest absolute value (N, 1) of each row (N, 3), in a tenth of the time of a maximum along the rows."""
    x, y, z = _columns(np.abs(rows))
    return np.maximum(np.maximum(x, y), z)


def _columns(rows: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    return rows[:, 0:1], rows[:, 1:2], rows[:, 2:3]


def _cosine_sine(degrees: float) -> tuple[float, float]:
    quarters = round(math.fmod(degrees, 360.0) / 90.0)
    rest = math.radians(math.fmod(degrees, 360.0) - 90.0 * quarters)
    cosine, sine = math.cos(rest), math.sin(rest)
    turned = [(cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine)]
    return turned[quarters % 4]
