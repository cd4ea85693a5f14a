"""Spheres, smooth or displaced by random waves, and hills of such waves over the xz plane; y is the axis.

Directions are (cos(azimuth) s, y, -sin(azimuth) s): u goes eastwards, v from the south pole to the
north pole. A pole is one vertex; the seam at u = 0 and u = 1 is two with the same bits.
"""

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.shapes.grid import circle, lattice_triangles, lattice_uv, normalised
from course.engine.shapes.mesh import Mesh

WAVES = 8


@dataclass(frozen=True)
class Waves:
    """f(x) = mean over k of sin(vectors[k] . x + phases[k]), so that |f| <= 1.

    Attributes
    ----------
    vectors : (K, D) float64, wave vectors [rad per unit of x]
    phases : (K,) float64 [rad]
    """

    vectors: NDArray[np.float64]
    phases: NDArray[np.float64]

    def __call__(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return f (V,) and its gradient (V, D) at `points` (V, D)."""
        value = np.zeros(len(points))
        gradient = np.zeros(points.shape)
        # One wave at a time: a lattice may have millions of points.
        for vector, phase in zip(self.vectors, self.phases, strict=True):
            angle = np.sum(points * vector, axis=1) + phase
            value += np.sin(angle)
            gradient += np.cos(angle)[:, None] * vector
        return value / len(self.phases), gradient / len(self.phases)


def random_waves(seed: int, dimensions: int, wave_number: float) -> Waves:
    """Return waves of `wave_number` / 2 to `wave_number` [rad per unit], in 2 or 3 dimensions.

    Python's own generator draws them: its `random()` is the same for a seed in every version,
    which NumPy's generators don't promise.
    """
    draw = random.Random(seed).random
    vectors, phases = [], []
    for k in range(WAVES):
        height = 2.0 * draw() - 1.0 if dimensions == 3 else 0.0
        across = math.sqrt(1.0 - height * height)
        azimuth = 2.0 * math.pi * draw()
        number = wave_number * (1.0 - 0.5 * k / (WAVES - 1))
        direction = (across * math.cos(azimuth), across * math.sin(azimuth), height)
        vectors.append([number * x for x in direction[:dimensions]])
        phases.append(2.0 * math.pi * draw())
    return Waves(np.array(vectors), np.array(phases))


def sphere(radius: float = 1.0, segments: int = 64) -> Mesh:
    """Return a sphere of `segments` meridians and half as many steps of latitude.

    Parameters
    ----------
    radius : [m], > 0. Every vertex lies on the sphere, so that the mesh is inscribed.
    segments : 3 to 4096
    """
    directions, triangles, uv = _globe(segments)
    return Mesh(radius * directions, triangles, directions, uv)


def displaced_sphere(
    radius: float = 1.0,
    amplitude: float = 0.1,
    frequency: float = 6.0,
    segments: int = 256,
    seed: int = 0,
) -> Mesh:
    """Return a bumpy ball: the distance from its centre varies smoothly with the direction.

    The surface is |x| = radius + amplitude f(x / |x|), f a mean of sine waves over the unit sphere;
    the normals are the gradient of |x| - amplitude f(x / |x|).

    Parameters
    ----------
    radius : mean distance from the centre [m], > 0
    amplitude : bound of the displacement [m], 0 <= amplitude < radius
    frequency : bumps around the ball, at most, 0 to 1e6. The mesh wants some 8 segments a bump.
    segments : Meridians, 3 to 4096
    seed : chooses the waves, >= 0
    """
    waves = random_waves(seed, 3, frequency)
    directions, triangles, uv = _globe(segments)
    height, gradient = waves(directions)
    relative = amplitude / radius
    distance = 1.0 + relative * height
    along = np.sum(gradient * directions, axis=1, keepdims=True)
    tangential = gradient - along * directions
    normals = normalised(directions - (relative / distance)[:, None] * tangential)
    vertices = radius * distance[:, None] * directions
    # A vector unit may round a sine differently in the tail of an array: copy, don't trust.
    for values in (vertices, normals):
        _close(values, segments)
    return Mesh(vertices, triangles, normals, uv)


def _globe(segments: int) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
    """Return unit directions (V, 3), triangles and uv: circles of latitude, then the two poles."""
    bands = max(2, segments // 2)
    cosine, sine = circle(segments)
    latitude = np.arange(1, bands) * (math.pi / bands)
    across, height = np.sin(latitude)[:, None], -np.cos(latitude)[:, None]
    south = (bands - 1) * (segments + 1)
    directions = np.empty((south + 2, 3))
    circles = directions[:south].reshape(bands - 1, segments + 1, 3)
    circles[..., 0] = across * cosine
    circles[..., 1] = height
    circles[..., 2] = -(across * sine)
    directions[south:] = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]]

    i = np.arange(segments, dtype=np.int32)
    last = i + (bands - 2) * (segments + 1)
    triangles = np.concatenate(
        [
            np.stack([np.full_like(i, south), i + 1, i], axis=1),
            lattice_triangles(segments, bands - 2),
            np.stack([last, last + 1, np.full_like(i, south + 1)], axis=1),
        ]
    )
    inner_uv = lattice_uv(segments, bands)[segments + 1 : -(segments + 1)]
    return directions, triangles, np.concatenate([inner_uv, [[0.5, 0.0], [0.5, 1.0]]])


def _close(values: NDArray[np.float64], segments: int) -> None:
    """Copy the first meridian of (V, 3) `values` onto the last, in place."""
    circles = values[:-2].reshape(-1, segments + 1, 3)
    circles[:, -1] = circles[:, 0]


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
    size : two floats, extent along x and along z [m], each > 0
    amplitude : bound of the height above and below 0 [m], >= 0
    frequency : waves along the longer side, at most, 0 to 1e6. The mesh wants some 8 segments a wave.
    segments : cells along either side, 1 to 4096
    seed : chooses the waves, >= 0
    """
    width, depth = size
    waves = random_waves(seed, 2, 2.0 * math.pi * frequency)
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
