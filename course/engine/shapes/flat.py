"""Flat shapes, of which every face has its own vertices, and solids of revolution about y with flat caps."""

import math
from collections.abc import Sequence

import numpy as np

from course.engine.shapes.grid import circle, join, lattice_triangles, lattice_uv
from course.engine.shapes.mesh import Mesh


def quad(width: float = 1.0, depth: float = 1.0) -> Mesh:
    """Return a rectangle in the xz plane, centred, facing +y; u along +x, v along -z.

    ``width``, ``depth``: extent along x and along z [m], > 0.
    """
    x, z = 0.5 * width, 0.5 * depth
    return Mesh(
        vertices=np.array([[-x, 0.0, z], [x, 0.0, z], [x, 0.0, -z], [-x, 0.0, -z]]),
        triangles=np.array([[0, 1, 2], [0, 2, 3]], np.int32),
        normals=np.tile([0.0, 1.0, 0.0], (4, 1)),
        uv=np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
    )


SLENDER = 16.0
"""A box whose length is more than this many times its other extents is cut into pieces of that many at most.

Rays leave long thin triangles from further above them, see ``course.engine.core.ray_offset``.
"""


def box(size: Sequence[float] = (1.0, 1.0, 1.0)) -> Mesh:
    """Return a box centred at the origin, six faces with 0..1 uv each and hard edges.

    ``size``: extent along x, y and z [m], each > 0. Long sides of a slender box are strips of quads, at
    most 256.
    """
    extent = np.array(size, np.float64)
    # All faces are cut at the same places, so no corner of one lies on an edge of another.
    _, second, longest = np.argsort(extent, kind="stable")
    cuts = np.ones(3, int)
    cuts[longest] = np.clip(np.ceil(extent[longest] / (SLENDER * extent[second])), 1, 256)
    faces = []
    for face in range(6):
        axis, sign = face // 2, 1.0 - 2.0 * (face % 2)
        # The u axis turns with the sign, so that u cross v points out of either face.
        u, v = (axis + 1) % 3, (axis + 2) % 3
        uv = lattice_uv(int(cuts[u]), int(cuts[v]))
        vertices, normals = np.empty((len(uv), 3)), np.zeros((len(uv), 3))
        vertices[:, axis] = sign * 0.5 * extent[axis]
        vertices[:, u] = sign * (uv[:, 0] - 0.5) * extent[u]
        vertices[:, v] = (uv[:, 1] - 0.5) * extent[v]
        normals[:, axis] = sign
        triangles = lattice_triangles(int(cuts[u]), int(cuts[v]))
        faces.append(Mesh(vertices, triangles, normals, uv))
    return join(faces)


def disk(radius: float = 1.0, segments: int = 64) -> Mesh:
    """Return a regular polygon in the xz plane, centred, facing +y; uv as seen from above.

    Parameters
    ----------
    radius : of the circle through the corners [m], > 0
    segments : Corners, 3 to 4096
    """
    return fan(radius, 0.0, segments, upwards=True)


def fan(radius: float, y: float, segments: int, *, upwards: bool) -> Mesh:
    """Return a disk at height y, about a vertex in its middle, facing up or down."""
    cosine, sine = (values[:-1] for values in circle(segments))
    facing = 1.0 if upwards else -1.0
    rim = np.stack([radius * cosine, np.full(segments, y), -(radius * sine)], axis=1)
    i = np.arange(segments, dtype=np.int32)
    following = (i + 1) % segments
    ends = (i, following) if upwards else (following, i)
    uv = np.stack([0.5 + 0.5 * cosine, 0.5 + 0.5 * facing * sine], axis=1)
    return Mesh(
        vertices=np.concatenate([rim, [[0.0, y, 0.0]]]),
        triangles=np.stack([np.full_like(i, segments), *ends], axis=1),
        normals=np.tile([0.0, facing, 0.0], (segments + 1, 1)),
        # Rounding may carry 1/2 + cos/2 one bit beyond the unit square.
        uv=np.clip(np.concatenate([uv, [[0.5, 0.5]]]), 0.0, 1.0),
    )


def cylinder(radius: float = 0.5, height: float = 1.0, segments: int = 64) -> Mesh:
    """Return a closed cylinder: a smooth side (u around, v up) and two flat caps.

    Parameters
    ----------
    radius, height : [m], > 0
    segments : Sides, 3 to 4096
    """
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
    radius, height : of the cap, and from cap to tip [m], > 0
    segments : Sides, 3 to 4096
    """
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
