"""PLY bytes to a `Part`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from course.geometry.mesh_formats import Array, Part
from course.geometry.mesh_polygons import Lists, fans
from course.geometry.ply_binary import binary_columns
from course.geometry.ply_columns import Column, text_columns
from course.geometry.ply_header import CORNERS, WEDGES, read_header
from course.geometry.ply_lines import wrong_wedges
from course.geometry.welding import same

UV = (("texture_u", "texture_v"), ("u", "v"), ("s", "t"))
"""What programs call the uv of a vertex; the format itself has no names for them."""


def parse_ply(data: bytes) -> list[Part]:
    """Return the mesh of a PLY file, its polygons cut into fans, with uv by vertex or by corner.

    Elements and properties of other names are left out. Faces whose list of uv is empty, while others have uv, are at
    (0, 0) with all corners.

    Raises
    ------
    ValueError
        For whatever is wrong with the header, a line or the length of the data, and for lists of uv that don't fit
        their faces.
    """
    header = read_header(data)
    columns = (text_columns if header.order == "ascii" else binary_columns)(header, data)
    vertex, face = columns.get("vertex", {}), columns.get("face", {})
    if not face:
        if "tristrips" in columns:
            raise ValueError(
                "its triangles are strips (element tristrips): write it anew with faces, such as by MeshLab"
            )
        return []
    corners = next(face[name] for name in CORNERS if name in face)
    # The header has none else.
    assert isinstance(corners, Lists)
    where = fans(corners.lengths)
    vertices = _stacked(vertex, tuple("xyz"))
    part = Part(
        vertices=np.zeros((0, 3)) if vertices is None else vertices,
        triangles=corners.values.astype(np.int64)[where],
        normals=_stacked(vertex, ("nx", "ny", "nz")),
        uv=next((uv for names in UV if (uv := _stacked(vertex, names)) is not None), None),
        transform=np.eye(4),
    )
    uv = _by_corner(corners.lengths, face.get(WEDGES))
    return [part if uv is None else _split_by_corner(part, uv[where.ravel()])]


def _stacked(columns: dict[str, Column], names: tuple[str, ...]) -> Array | None:
    """(N, len(names)) of columns of plain numbers; None where one is missing."""
    found = [columns.get(name) for name in names]
    plain = [each for each in found if isinstance(each, np.ndarray)]
    return np.column_stack(plain) if len(plain) == len(names) else None


def _by_corner(corners: NDArray[np.int64], uv: Column | None) -> Array | None:
    """(sum of the corners, 2) from the faces' lists; None where there are none, or nothing in them."""
    if not isinstance(uv, Lists) or not uv.lengths.any():
        return None
    wrong = (uv.lengths != 0) & (uv.lengths != 2 * corners)
    if wrong.any():
        face = int(np.argmax(wrong))
        raise ValueError(wrong_wedges(face, int(uv.lengths[face]), int(corners[face])))
    found = np.zeros((corners.sum(), 2), uv.values.dtype)
    found[np.repeat(uv.lengths > 0, corners)] = uv.values.reshape(-1, 2)
    return found


def _split_by_corner(part: Part, uv: Array) -> Part:
    """Return `part` with a vertex for each uv (3 T, 2) that its corners have."""
    vertex = part.triangles.ravel()
    first, corner = same(vertex, uv[:, 0], uv[:, 1])
    kept = vertex[first]
    if kept.min() < 0 or kept.max() >= len(part.vertices):
        return part  # the caller reports the index
    return Part(
        vertices=part.vertices[kept],
        triangles=corner.reshape(-1, 3),
        normals=None if part.normals is None else np.asarray(part.normals)[kept],
        uv=uv[first],
        transform=part.transform,
    )
