"""A triangle mesh as it is before the scene is compiled: float64, in the units of its file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Mesh:
    """Triangles over shared vertices.

    Attributes
    ----------
    vertices : (V, 3) float64 [m]
    triangles : (T, 3) integer
        Counter-clockwise seen from outside: cross(p1 - p0, p2 - p0) points outwards.
    normals : (V, 3) float64, not 0, or None
        Shading normals; None means flat shading. Of unit length, unless the mesh has been stretched unevenly: in a
        triangle, longer ones count more (`course.geometry.transforms.apply`).
    uv : (V, 2) float64 or None
        Surface parameters.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.integer]
    normals: NDArray[np.float64] | None = None
    uv: NDArray[np.float64] | None = None
