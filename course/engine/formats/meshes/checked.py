"""From a `FilePart`, as it stands in a file, to a mesh that can be used: finite, in range, with normals."""

import warnings
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from course.base.errors import CourseWarning, GeometryError
from course.engine.core.types import Floats64
from course.engine.core.vectors import dot
from course.engine.formats.meshes.parts import FilePart
from course.engine.formats.meshes.smooth_normals import (
    angle_normals,
    area_normals,
    edges_and_faces,
    smooth_normals,
    unit,
)
from course.engine.shapes.mesh import Mesh

# Beyond this, squares of distances overflow float64; no unit makes a scene that large.
FARTHEST = 1e150

# Areas of triangles of size 1 under which rounding decides where they look.
SLIVER = 1e-6

# Cosine of an angle to a normal, from which on rounding hasn't decided on which side it is.
ALONG = 0.99

# Share of an STL file's triangles along whose facet normals they must lie; else these are no normals, and tell nothing.
MOSTLY = 0.99

Weights = Literal["angle", "area"]
"""By what the faces around a vertex count in its normal."""


def checked(name: str, part: FilePart, weights: Weights) -> Mesh:
    """Return the mesh of `part`, in its own frame; GeometryError for what can't be used."""
    vertices = np.array(part.vertices, np.float64)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise GeometryError(f"{name}: vertices have shape {vertices.shape}: expected (V, 3)")
    triangles = part.triangles
    outside = (triangles < 0) | (triangles >= len(vertices))
    if outside.any():
        t, corner = np.argwhere(outside)[0]
        raise GeometryError(
            f"{name}: triangle {t} refers to vertex {triangles[t, corner]}: "
            f"out of range, there are {len(vertices)}, from 0"
        )
    unusable = _without_odd_rows(name, "vertex", vertices, triangles, FARTHEST)
    if len(vertices) <= np.iinfo(np.int32).max:
        triangles = triangles.astype(np.int32)
    normals: Floats64 | None
    normals, given = _normals(name, part, len(vertices))
    stored = np.asarray(part.vertices).dtype
    precision = float(np.finfo(stored).eps) if stored.kind == "f" else 0.0
    if given.any():
        first, second, third = (normals[corner] for corner in triangles.T)
        out = first + second + third
        triangles = _outwards(name, vertices, triangles, out, precision)
    elif part.facets is not None:
        facets = unit(np.nan_to_num(np.array(part.facets, np.float64), posinf=0.0, neginf=0.0))
        triangles = _outwards(name, vertices, triangles, facets, precision, MOSTLY)
    if part.flat:
        normals = None
    elif not given.all():
        normals = np.where(given, normals, _computed(part, vertices, triangles, weights))
    mesh = Mesh(vertices, triangles, normals, _uv(name, part, len(vertices)))
    return _used(mesh) if unusable else mesh


def _computed(
    part: FilePart, vertices: Floats64, triangles: NDArray[np.integer], weights: Weights
) -> Floats64:
    """The normals (V, 3) that the file doesn't have."""
    if part.shared is None:
        compute = area_normals if weights == "area" else smooth_normals
        return compute(vertices, triangles)
    # Vertices of one normal lie at one place.
    places = np.zeros((int(part.shared.max(initial=-1)) + 1, 3))
    places[part.shared] = vertices
    shared = part.shared[triangles]
    normals = area_normals(places, shared) if weights == "area" else angle_normals(places, shared)
    return normals[part.shared]


def _used(mesh: Mesh) -> Mesh:
    """The mesh without vertices that no triangle has."""
    used = np.zeros(len(mesh.vertices), bool)
    used[mesh.triangles] = True
    number = (np.cumsum(used) - 1).astype(mesh.triangles.dtype)
    normals, uv = (rows if rows is None else rows[used] for rows in (mesh.normals, mesh.uv))
    return Mesh(mesh.vertices[used], number[mesh.triangles], normals, uv)


def _normals(
    name: str, part: FilePart, count: int
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the file's normals (V, 3), made unit or 0, and (V, 1) which vertices have one."""
    if part.normals is None:
        return np.zeros((count, 3)), np.zeros((count, 1), bool)
    normals = np.array(part.normals, np.float64)
    if normals.shape != (count, 3):
        raise GeometryError(f"{name}: {len(normals)} normals for {count} vertices")
    odd = ~np.isfinite(normals).all(axis=1)
    if odd.any():
        normals[odd] = 0.0
        used = np.zeros(count, bool)
        used[part.triangles] = True
        if (odd & used).any():
            warnings.warn(
                f"{name}: {np.count_nonzero(odd & used):,} of {count:,} normals are not numbers, and are computed from"
                " the faces instead",
                CourseWarning,
                stacklevel=2,
            )
    return unit(normals), np.asarray(normals.any(axis=1, keepdims=True))


def _outwards(
    name: str,
    vertices: NDArray[np.float64],
    triangles: NDArray[np.integer],
    out: NDArray[np.float64],
    precision: float,
    mostly: float = 0.0,
) -> NDArray[np.integer]:
    """Return triangles that look to the same side as ``out`` (T, 3); warn of those that were turned.

    Parameters
    ----------
    precision : a coordinate as the file holds it is right to so many times its distance from 0
    mostly : least share of triangles along whose ``out`` they lie, on either side; of fewer none is turned
    """
    wrong, along, looking = np.zeros((3, len(triangles)), bool)
    for which, _, faces, lengths in edges_and_faces(vertices, triangles):
        side = np.ascontiguousarray(out[which].T)
        ahead = dot(faces, side)
        sizes = np.sqrt(dot(faces, faces) * dot(side, side))
        along[which], looking[which] = np.abs(ahead) > ALONG * sizes, sizes > SLIVER
        # A sliver that rounding alone gives an area looks nowhere.
        far = np.abs(vertices[triangles[which]]).max(axis=(1, 2))
        rounding = np.where(along[which], 0.0, 16 * precision * far / lengths)
        wrong[which] = ahead < -(SLIVER + rounding)
    if not wrong.any() or np.count_nonzero(along & looking) < mostly * np.count_nonzero(looking):
        return triangles
    warnings.warn(
        f"{name}: {np.count_nonzero(wrong):,} of {len(wrong):,} triangles are wound against their "
        "normals; they were turned, so that the normals' side is the outside",
        CourseWarning,
        stacklevel=2,
    )
    return np.where(wrong[:, None], triangles[:, [0, 2, 1]], triangles)


def _uv(name: str, part: FilePart, count: int) -> NDArray[np.float64] | None:
    if part.uv is None:
        return None
    uv = np.array(part.uv, np.float64)
    # Some files carry a third texture coordinate, always 0.
    if uv.ndim != 2 or len(uv) != count or uv.shape[1] < 2:
        raise GeometryError(f"{name}: uv have shape {uv.shape}: expected ({count}, 2)")
    uv = uv[:, :2].copy()
    _without_odd_rows(name, "uv", uv, part.triangles)
    return uv


def _without_odd_rows(
    name: str,
    noun: str,
    rows: NDArray[np.float64],
    triangles: NDArray[np.integer],
    farthest: float = np.inf,
) -> bool:
    """Refuse rows that aren't finite or lie too far away; others become 0. Whether there are any."""
    finite = np.asarray(np.isfinite(rows).all(axis=1))
    odd = np.asarray(~finite | (np.abs(rows).max(axis=1, initial=0.0) > farthest))
    if not odd.any():
        return False
    used = np.zeros(len(rows), bool)
    used[triangles] = True
    if (odd & used).any():
        k = int(np.argmax(odd & used))
        what = f"beyond {farthest:g}" if finite[k] else "expected finite numbers"
        raise GeometryError(f"{name}: {noun} {k} is {_row(rows, k)}: {what}")
    rows[odd] = 0.0
    return True


def _row(rows: NDArray[np.float64], k: int) -> str:
    return "(" + ", ".join(f"{x:g}" for x in rows[k]) + ")"
