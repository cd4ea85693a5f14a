"""Meshes that stand in the scene file itself, written beside the converted scene as binary PLY in double precision."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from course.errors import OutputError
from course.geometry.mesh import Mesh
from course.imaging.atomic import replacing


def write_ply(mesh: Mesh, path: Path) -> None:
    """Write vertices, normals where there are some, and triangles, every bit of them.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    columns = [mesh.vertices]
    names = ["x", "y", "z"]
    if mesh.normals is not None:
        columns.append(mesh.normals)
        names += ["nx", "ny", "nz"]
    header = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(mesh.vertices)}",
        *(f"property double {name}" for name in names),
        f"element face {len(mesh.triangles)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    faces = np.empty(len(mesh.triangles), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    faces["count"] = 3
    faces["corners"] = mesh.triangles
    content = ("\n".join(header) + "\n").encode("ascii")
    content += np.concatenate(columns, axis=1).astype("<f8").tobytes() + faces.tobytes()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path.parent}: can't be made: {error.strerror or error}") from error
    with replacing(path) as temporary:
        temporary.write_bytes(content)
