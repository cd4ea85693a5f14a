"""Triangles over shared vertices: what shapes make and files hold."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Mesh:
    """A mesh, before the scene is moved and scaled.

    Attributes
    ----------
    vertices : (V, 3) float64 [m]
    triangles : (T, 3) integer, counter-clockwise seen from outside: cross(p1 - p0, p2 - p0) points outwards
    normals : (V, 3) float64 shading normals, not 0; None for flat shading. Unit vectors, unless the mesh has been
        scaled non-uniformly (`course.engine.formats.meshes.transforms.apply`)
    uv : (V, 2) float64 texture coordinates or None
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.integer]
    normals: NDArray[np.float64] | None = None
    uv: NDArray[np.float64] | None = None
