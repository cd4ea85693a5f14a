"""Hemicubes rendered through Embree: which patch is seen through each cell.

A cell has a ray from the patch's centre through the middle of the cell. The hemicubes of different patches are turned
about their normals by different angles, so that the errors of their grids don't add up.
"""

import math
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import QueryStats
from course.engine.core.types import Floats32, Floats64, Indices
from course.engine.radiosity.patches import Patches, RadiosityFunctions

RAYS = 1 << 16
"""In a batch."""

ABOVE = 2.0**-18
"""Rays leave from this far above their patch, in a scene that fills [-1, 1]."""

GOLDEN = (math.sqrt(5) - 1) / 2

Seen = NDArray[np.int32]
"""Numbers of patches, -1 where nothing is seen."""


@dataclass(frozen=True)
class Hemicube:
    """C = 3 k^2 cells.

    Attributes
    ----------
    directions : (3, C) float32 through the middles of the cells, z along the normal
    factors : (C,) float64, delta form factors that sum to 1
    """

    directions: Floats32
    factors: Floats64

    @property
    def cells(self) -> int:
        """Number of cells."""
        return len(self.factors)


def make_hemicube(k: int, functions: RadiosityFunctions) -> Hemicube:
    """A hemicube of k cells along the edges of its top."""
    x = ((np.arange(k) + 0.5) * (2 / k) - 1).astype(np.float32)
    across, along = (part.ravel() for part in np.meshgrid(x, x))
    top = np.stack((across, along, np.ones_like(across)))
    wide, high = (part.ravel() for part in np.meshgrid(x, x[k // 2 :]))
    wall = np.ones_like(wide)
    sides = [(wall, wide), (-wall, wide), (wide, wall), (wide, -wall)]
    directions = [top, *(np.stack((a, b, high)) for a, b in sides)]
    of_top, of_side = functions.hemicube_form_factors(k)
    factors = np.concatenate([of_top.ravel(), *[of_side.ravel()] * 4]).astype(np.float64)
    # The grid's error would make or lose light in a closed room.
    return Hemicube(np.concatenate(directions, axis=1), factors / (factors.sum() or 1))


class Views:
    """Views from the patches, through hemicubes."""

    def __init__(self, patches: Patches) -> None:
        corners = patches.triangles.corners.astype(np.int32)
        vertices = patches.triangles.vertices.astype(np.float32)
        p = patches.triangles.vertices[corners]
        normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        tangent = p[:, 1] - p[:, 0]
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        angle = (np.arange(patches.size) * GOLDEN % 1 * (math.pi / 2))[:, None]
        tangent = np.cos(angle) * tangent + np.sin(angle) * np.cross(normal, tangent)
        # One more row, of nothing, at -1.
        self._normal = np.concatenate((normal, np.zeros((1, 3)))).astype(np.float32)
        self._plane = np.append(np.einsum("nx,nx->n", normal, p[:, 0]), 0).astype(np.float32)
        self._number = np.arange(patches.size + 1, dtype=np.int32)
        self._basis = np.stack((tangent, np.cross(normal, tangent), normal)).astype(np.float32)
        self._centre = p.mean(axis=1)
        self._above = normal * ABOVE
        self._size = patches.size
        self._accelerator = static_accelerator(vertices, corners)
        self._threads = os.cpu_count() or 1
        self.rays = 0

    def look(self, which: Indices, hemicube: Hemicube) -> Seen:
        """The views from some patches through the cells of their hemicubes.

        ``which``: (m,) numbers of patches.
        Returns (m, C) int32.
        """
        seen = np.empty((len(which), hemicube.cells), np.int32)
        self.rays += seen.size

        def fill(part: tuple[int, slice]) -> None:
            row, cells = part
            self._look(int(which[row]), hemicube.directions[:, cells], seen[row, cells])

        starts = range(0, hemicube.cells, RAYS)
        parts = [(row, slice(s, s + RAYS)) for row in range(len(which)) for s in starts]
        if len(parts) == 1 or self._threads == 1:
            for part in parts:
                fill(part)
        else:
            with ThreadPoolExecutor(self._threads) as pool:
                list(pool.map(fill, parts))
        return seen

    def _look(self, patch: int, local: Floats32, seen: Seen) -> None:
        back, triangle = divmod(patch, self._size)
        side = np.float32(-1 if back else 1)
        basis = self._basis[:, triangle].copy()
        basis[2] *= side  # turned round, and still orthonormal
        origin = self._centre[triangle] + side * self._above[triangle]
        start = origin.astype(np.float32)
        hit = self._accelerator.intersect(start[:, None], basis.T @ local, QueryStats()).triangle
        # All hits of a triangle are on the side on which the hemicube is; for -1, nothing, there is a last one.
        number = self._number + self._size * (self._normal @ start < self._plane)
        number[-1] = -1
        seen[:] = number[hit]

    def row(self, seen: Seen, hemicube: Hemicube) -> Floats32:
        """(P,) form factors of a patch from what it sees, (C,)."""
        sums = np.bincount(seen + 1, weights=hemicube.factors, minlength=2 * self._size + 1)
        return sums[1:].astype(np.float32)
