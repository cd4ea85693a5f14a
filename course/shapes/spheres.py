"""Spheres in circles of latitude, smooth or displaced by waves; y is the axis.

Directions are (cos(azimuth) s, y, -sin(azimuth) s): u goes eastwards, v from the south pole to the
north pole. A pole is one vertex; the seam at u = 0 and u = 1 is two with the same bits.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from course.core.triangles import Mesh
from course.shapes.checks import at_least_zero, count, finite, length
from course.shapes.grid import circle, lattice_triangles, lattice_uv, normalised
from course.shapes.waves import random_waves


def sphere(radius: float = 1.0, segments: int = 64) -> Mesh:
    """Return a sphere of `segments` meridians and half as many steps of latitude.

    Parameters
    ----------
    radius : float
        [m], > 0. Every vertex lies on the sphere, so that the mesh is inscribed.
    segments : int
        3 to 4096.

    Raises
    ------
    ValueError
        For a parameter out of range.
    """
    radius = length("radius", radius)
    directions, triangles, uv = _globe(count("segments", segments, 3, 4096))
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
    radius : float
        Mean distance from the centre [m], > 0.
    amplitude : float
        Bound of the displacement [m], 0 <= amplitude < radius.
    frequency : float
        Bumps around the ball, at most, 0 to 1e6. The mesh wants some 8 segments a bump.
    segments : int
        Meridians, 3 to 4096.
    seed : int
        Chooses the waves, >= 0.

    Raises
    ------
    ValueError
        For a parameter out of range.
    """
    radius = length("radius", radius)
    amplitude = finite("amplitude", amplitude)
    if not 0.0 <= amplitude < radius:
        raise ValueError(f"amplitude is {amplitude:g}: expected 0 to below the radius, {radius:g}")
    frequency = at_least_zero("frequency", frequency, 1e6)
    segments = count("segments", segments, 3, 4096)
    waves = random_waves(count("seed", seed, 0, 2**32 - 1), 3, frequency)

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


def _globe(
    segments: int,
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
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
