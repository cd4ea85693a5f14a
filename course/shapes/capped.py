"""Solids of revolution with flat caps, centred at the origin, about the y axis."""

from __future__ import annotations

import math

import numpy as np

from course.core.triangles import Mesh
from course.shapes.checks import count, length
from course.shapes.flat import fan
from course.shapes.grid import circle, lattice_triangles, lattice_uv
from course.shapes.joining import join


def cylinder(radius: float = 0.5, height: float = 1.0, segments: int = 64) -> Mesh:
    """Return a closed cylinder: a smooth side (u around, v up) and two flat caps.

    Parameters
    ----------
    radius, height : float
        [m], > 0.
    segments : int
        Sides, 3 to 4096.

    Raises
    ------
    ValueError
        For a parameter out of range.
    """
    radius, height = length("radius", radius), length("height", height)
    segments = count("segments", segments, 3, 4096)
    cosine, sine = circle(segments)
    level = np.zeros(segments + 1)
    bottom = np.stack([radius * cosine, level - 0.5 * height, -(radius * sine)], axis=1)
    top = np.stack([radius * cosine, level + 0.5 * height, -(radius * sine)], axis=1)
    side = Mesh(
        vertices=np.concatenate([bottom, top]),
        triangles=lattice_triangles(segments, 1),
        normals=np.tile(np.stack([cosine, level, -sine], axis=1), (2, 1)),
        uv=lattice_uv(segments, 1),
    )
    caps = (
        fan(radius, -0.5 * height, segments, upwards=False),
        fan(radius, 0.5 * height, segments, upwards=True),
    )
    return join([side, *caps])


def cone(radius: float = 0.5, height: float = 1.0, segments: int = 64) -> Mesh:
    """Return a closed cone, its tip at y = height / 2: a smooth side and a flat cap below.

    The normal has no limit at the tip, so that each side has a tip of its own there, with the
    normal of the side's middle.

    Parameters
    ----------
    radius, height : float
        Of the cap, and from cap to tip [m], > 0.
    segments : int
        Sides, 3 to 4096.

    Raises
    ------
    ValueError
        For a parameter out of range.
    """
    radius, height = length("radius", radius), length("height", height)
    segments = count("segments", segments, 3, 4096)
    cosine, sine = circle(segments)
    slant = math.hypot(radius, height)
    out, up = height / slant, radius / slant
    rim = np.stack([radius * cosine, np.full(segments + 1, -0.5 * height), -(radius * sine)], 1)
    rim_normals = np.stack([out * cosine, np.full(segments + 1, up), -(out * sine)], axis=1)
    middle = (np.arange(segments) + 0.5) * (2.0 * math.pi / segments)
    tip_normals = np.stack(
        [out * np.cos(middle), np.full(segments, up), -(out * np.sin(middle))], axis=1
    )
    i = np.arange(segments, dtype=np.int32)
    uv = np.ones((2 * segments + 1, 2))
    uv[: segments + 1, 0] = np.arange(segments + 1) / segments
    uv[: segments + 1, 1] = 0.0
    uv[segments + 1 :, 0] = (np.arange(segments) + 0.5) / segments
    side = Mesh(
        vertices=np.concatenate([rim, np.tile([0.0, 0.5 * height, 0.0], (segments, 1))]),
        triangles=np.stack([i, i + 1, i + (segments + 1)], axis=1),
        normals=np.concatenate([rim_normals, tip_normals]),
        uv=uv,
    )
    return join([side, fan(radius, -0.5 * height, segments, upwards=False)])
