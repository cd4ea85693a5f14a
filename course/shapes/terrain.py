"""A patch of rolling ground: height over the xz plane from a mean of sine waves."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from course.core.triangles import Mesh
from course.shapes.checks import at_least_zero, count, length
from course.shapes.grid import lattice_triangles, lattice_uv, normalised
from course.shapes.waves import random_waves


def height_field(
    size: Sequence[float] = (1.0, 1.0),
    amplitude: float = 0.1,
    frequency: float = 4.0,
    segments: int = 128,
    seed: int = 0,
) -> Mesh:
    """Return an open sheet y = amplitude f(x, z), centred, facing +y; u along +x, v along -z.

    Parameters
    ----------
    size : two floats
        Extent along x and along z [m], each > 0.
    amplitude : float
        Bound of the height above and below 0 [m], >= 0.
    frequency : float
        Waves along the longer side, at most, 0 to 1e6. The mesh wants some 8 segments a wave.
    segments : int
        Cells along either side, 1 to 4096.
    seed : int
        Chooses the waves, >= 0.

    Raises
    ------
    ValueError
        For a parameter out of range.
    """
    if len(size) != 2:
        raise ValueError(f"size has {len(size)} numbers: expected 2")
    width, depth = length("size[0]", size[0]), length("size[1]", size[1])
    amplitude = at_least_zero("amplitude", amplitude)
    frequency = at_least_zero("frequency", frequency, 1e6)
    segments = count("segments", segments, 1, 4096)
    waves = random_waves(count("seed", seed, 0, 2**32 - 1), 2, 2.0 * math.pi * frequency)

    longer = max(width, depth)
    uv = lattice_uv(segments, segments)
    x, z = (uv[:, 0] - 0.5) * width, (0.5 - uv[:, 1]) * depth
    height, gradient = waves(np.stack([x, z], axis=1) / longer)
    slope = amplitude / longer * gradient
    normals = np.stack([-slope[:, 0], np.ones(len(uv)), -slope[:, 1]], axis=1)
    return Mesh(
        vertices=np.stack([x, amplitude * height, z], axis=1),
        triangles=lattice_triangles(segments, segments),
        normals=normalised(normals),
        uv=uv,
    )
