"""The frame of the compiled scene: its own centre as origin, its own size as unit.

Everything is moved and scaled in float64 before it becomes float32, so a scene in nanometres or parsecs, at the
origin or 10^8 of its sizes away, gives the same picture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats64
from course.geometry.mesh import Mesh


@dataclass(frozen=True)
class Frame:
    """x_compiled = (x - center) / scale, for positions in the units of the scene file.

    Attributes
    ----------
    center : (3,) float64
    scale : float > 0, half the longest extent of all objects
    """

    center: Floats64
    scale: float

    def position(self, x: Sequence[float] | Floats64) -> Floats64:
        """Compiled positions, (3,) or (V, 3) float64."""
        moved: Floats64 = np.asarray(x, np.float64) - self.center
        return moved / self.scale

    def vector(self, x: Sequence[float] | Floats64) -> Floats64:
        """Compiled differences of positions."""
        scaled: Floats64 = np.asarray(x, np.float64) / self.scale
        return scaled

    def mesh(self, mesh: Mesh) -> Mesh:
        """A compiled mesh; normals don't change."""
        return Mesh(self.position(mesh.vertices), mesh.triangles, mesh.normals, mesh.uv)


def frame_of(meshes: list[Mesh]) -> Frame:
    """The frame in which all meshes just fill [-1, 1]."""
    used = [mesh.vertices[mesh.triangles.ravel()] for mesh in meshes if len(mesh.triangles)]
    if not used:
        return Frame(np.zeros(3), 1.0)
    low = np.min([v.min(axis=0) for v in used], axis=0)
    high = np.max([v.max(axis=0) for v in used], axis=0)
    # Halved before they are added: the sum of two huge coordinates may overflow.
    center = low / 2 + high / 2
    scale = float((high / 2 - low / 2).max())
    return Frame(center, scale if scale > 0 else 1.0)
