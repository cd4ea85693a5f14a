"""Infinite planes, as squares so large that their edges are as good as the horizon.

A plane is a square around the middle of everything else, and rings about it, each twice as wide as the one inside.
Triangles close by are small, so that rays leave them as they would leave any floor, and those far off are large.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from course.core.triangles import Mesh
from course.core.types import Floats64
from course.formats.metu.lights import tangents

RINGS: Final = 12
"""The outermost is 2^12 times as far away as the farthest thing in the scene.

From a camera as high as the scene is large it ends 1/4096 rad below the horizon.
"""

CORNERS: Final = ((-1, -1), (1, -1), (1, 1), (-1, 1))
"""Counter-clockwise about the normal."""


def plane_mesh(point: Floats64, normal: Floats64, others: Floats64) -> Mesh:
    """The square of a plane.

    Parameters
    ----------
    point, normal : (3,), of any length
    others : (N, 3) corners of everything else in the scene, cameras among it
    """
    normal = normal / np.abs(normal).max()
    normal = normal / np.linalg.norm(normal)
    middle = (others.min(axis=0) + others.max(axis=0)) / 2 if len(others) else point
    # The square's middle is below the scene's: the compiled scene, which lies about its own middle, keeps its digits.
    center = middle - normal * float(normal @ (middle - point))
    half = float(np.linalg.norm(others - center, axis=1).max()) if len(others) else 0.0
    half = half or 1.0
    u, v = tangents(normal)
    squares = [
        center + half * 2.0**ring * (a * u + b * v) for ring in range(RINGS + 1) for a, b in CORNERS
    ]
    triangles = [(0, 1, 2), (0, 2, 3)]
    for ring in range(RINGS):
        for k in range(4):
            a, b = 4 * ring + k, 4 * ring + (k + 1) % 4
            triangles += [(a, a + 4, b + 4), (a, b + 4, b)]
    return Mesh(np.array(squares), np.array(triangles, np.int32), None)


def corners_of_all(meshes: list[tuple[Floats64, dict[str, Any]]]) -> Floats64:
    """Corners (N, 3) of the boxes around vertices, where they start and where their objects' motion takes them.

    Parameters
    ----------
    meshes : vertices (V, 3) where the scene has them, and the keys of their object
    """
    found = []
    for vertices, thing in meshes:
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        ends = np.array(np.meshgrid(*np.stack((low, high), axis=1))).reshape(3, 8).T
        found += [ends, ends + thing.get("motion", {}).get("velocity", 0.0)]
    return np.concatenate(found) if found else np.zeros((0, 3))
