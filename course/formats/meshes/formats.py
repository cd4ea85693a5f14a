"""What the readers of mesh files return, and STL and GLB from trimesh's parsers to it.

The parsers are called without the classes above them, which would merge, drop or recompute what the file holds.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

# What trimesh makes of a wrong file it writes to its log, tracebacks too, which Python prints if nobody listens.
logging.getLogger("trimesh").addHandler(logging.NullHandler())


@dataclass(frozen=True)
class Part:
    """One geometry of a file, as it stands there: nothing is checked.

    Attributes
    ----------
    vertices : (V, 3)
    triangles : (T, 3) integer
    normals : (V, 3) or None
        Of any length.
    uv : (V, 2) or None
        v upwards.
    transform : (4, 4) float64
        From the part's frame to the file's.
    """

    vertices: Array
    triangles: Array
    normals: Array | None
    uv: Array | None
    transform: NDArray[np.float64]


def parse_stl(data: bytes) -> list[Part]:
    """Return the solids of an STL file, each triangle with vertices of its own."""
    from trimesh.exchange.stl import load_stl

    return _parts(load_stl(BytesIO(data)))


def _parts(parsed: dict[str, Any]) -> list[Part]:
    """Return the parts of trimesh's keyword arguments for one mesh or for a scene of several."""
    geometries = parsed.get("geometry", {"": parsed})
    return [part for g in geometries.values() if (part := part_of(g, np.eye(4))) is not None]


def part_of(
    geometry: dict[str, Any], transform: NDArray[np.float64], uv: Array | None = None
) -> Part | None:
    """Return the Part of trimesh's keyword arguments for one mesh, None if it has no faces."""
    faces = geometry.get("faces")
    if faces is None or len(faces) == 0:
        return None
    return Part(
        vertices=np.asarray(geometry["vertices"]),
        triangles=np.asarray(faces, np.int64),
        normals=geometry.get("vertex_normals"),
        uv=uv,
        transform=transform,
    )
