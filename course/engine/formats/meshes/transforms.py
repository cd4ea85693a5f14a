"""Affine transforms: (4, 4) float64 matrices that act on columns (x, y, z, 1)."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from course.engine.shapes.mesh import Mesh

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
    return apply_all(mesh, matrix[None])


def apply_all(mesh: Mesh, matrices: Matrix) -> Mesh:
    """Return one mesh of `mesh` transformed by each of the matrices (K, 4, 4), as `apply` does with one."""
    if not np.all(np.isfinite(matrices)):
        raise ValueError("matrix holds a number that is not finite")
    ends = matrices[:, 3]
    if (wrong := (ends != [0.0, 0.0, 0.0, 1.0]).any(axis=1)).any():
        last = ends[np.argmax(wrong)].tolist()
        raise ValueError(f"matrix ends in {last}: expected [0, 0, 0, 1]")
    linear = matrices[:, :3, :3]
    sign = np.linalg.slogdet(linear).sign
    if not sign.all():
        raise ValueError("matrix can't be inverted: it flattens the mesh")

    with np.errstate(over="ignore", invalid="ignore"):
        vertices = _rows_times(mesh.vertices, np.swapaxes(linear, 1, 2)) + matrices[:, None, :3, 3]
    if not np.all(np.isfinite(vertices)):
        raise ValueError("matrix moves a vertex out of the range of float64")
    normals = None if mesh.normals is None else _transformed_normals(mesh.normals, linear)
    return Mesh(
        vertices.reshape(-1, 3),
        _repeated(mesh, sign),
        None if normals is None else normals.reshape(-1, 3),
        mesh.uv if mesh.uv is None or len(sign) == 1 else np.tile(mesh.uv, (len(sign), 1)),
    )


def _repeated(mesh: Mesh, signs: NDArray[np.float64]) -> NDArray[np.integer]:
    """The triangles of so many copies of a mesh, wound the other way round where a sign is negative."""
    if len(signs) == 1:
        same = mesh.triangles
        return same if signs[0] > 0.0 else np.ascontiguousarray(same[:, ::-1])
    count = len(mesh.vertices)
    kind = np.int32 if count * len(signs) <= np.iinfo(np.int32).max else np.int64
    first = np.arange(len(signs), dtype=kind)[:, None, None] * count
    copies: NDArray[np.integer] = np.add(mesh.triangles, first, dtype=kind)
    copies[signs < 0.0] = copies[signs < 0.0][:, :, ::-1]
    return copies.reshape(-1, 3)


def _transformed_normals(normals: NDArray[np.float64], linear: Matrix) -> NDArray[np.float64]:
    """Normals (K, V, 3) under each of the matrices (K, 3, 3)."""
    # The inverse transpose has the direction of the matrix of cofactors, and its sign keeps outward
    # normals outward under a mirror. One factor for all normals is free.
    scaled = linear / np.max(np.abs(linear), axis=(1, 2), keepdims=True)
    inverse = np.linalg.inv(scaled)
    if not np.all(np.isfinite(inverse)):
        raise ValueError("matrix can't be inverted: it flattens the mesh")
    inverse /= np.max(np.abs(inverse), axis=(1, 2), keepdims=True)
    turned = _rows_times(normals, inverse)
    largest = _largest(turned)
    turned = turned / np.where(largest > 0.0, largest, 1.0)
    x, y, z = _columns(turned * turned)
    lengths = np.sqrt(x + y + z)
    unit = turned / np.where(lengths > 0.0, lengths, 1.0)
    # By its largest singular value, the longest that the image of a unit vector can be.
    longest = np.linalg.norm(inverse, 2, axis=(1, 2))[:, None, None]
    lengths = lengths * (largest / longest)
    # Where nothing is stretched unevenly, unit vectors stay just that.
    lengths = np.where(np.abs(lengths - 1.0) < ROUNDING, 1.0, np.maximum(lengths, SHORTEST))
    # A scale so uneven that a normal underflows leaves the original direction, which hardly counts.
    before = normals / np.maximum(_largest(normals), SHORTEST)
    return np.where(largest > 0.0, unit, before) * lengths


def _rows_times(rows: NDArray[np.float64], matrices: Matrix) -> NDArray[np.float64]:
    """Return rows (V, 3) @ each of the matrices (K, 3, 3), by products and sums of columns: (K, V, 3).

    A BLAS may round a row differently depending on where in the array it stands, and two copies of
    one vertex would part.
    """
    x, y, z = _columns(rows)
    m = matrices[:, :, None, :]
    return np.asarray(x * m[:, 0] + y * m[:, 1] + z * m[:, 2])


def _largest(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """The largest absolute value of each row of three, in a tenth of the time of a maximum along the rows."""
    x, y, z = _columns(np.abs(rows))
    return np.maximum(np.maximum(x, y), z)


def _columns(rows: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    return rows[..., 0:1], rows[..., 1:2], rows[..., 2:3]


def _cosine_sine(degrees: float) -> tuple[float, float]:
    quarters = round(math.fmod(degrees, 360.0) / 90.0)
    rest = math.radians(math.fmod(degrees, 360.0) - 90.0 * quarters)
    cosine, sine = math.cos(rest), math.sin(rest)
    turned = [(cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine)]
    return turned[quarters % 4]
