"""Offsets of ray origins, so that rounding never lets a triangle occlude its own rays.

Symbols as in ``course.engine.core.triangles``.

The bulge. A coarse mesh with smooth normals stands for a round surface above its flat triangles. Near the terminator,
some facets face away from a light that their shading normals face: their shadow rays hit the facets themselves, and
the mesh shows black teeth. So these rays start from the round surface, higher by

    h(u, v) = 1/2 (w u k01 + w v k02 + u v k12),    k_ij = (p_j - p_i) . (n_j - n_i)

Along an edge, h is a parabola through both ends. Its slope changes by as much as the normals turn. If the normals lean
outwards by equal angles, it meets them at right angles, up to third-order terms. An edge of length L on a sphere of
radius R has k = L^2 / R; at its middle h is, to leading order, the sagitta L^2 / (8 R). Hanika ("Hacking the shadow
terminator", Ray Tracing Gems II, ch. 4) projects the point onto the tangent planes. His point lies twice as high.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats32, Floats64, Indices, Numbers
from course.engine.core.vectors import cross, dot, gather

if TYPE_CHECKING:
    from course.engine.core.hits import Hits

OFFSET = 2.0**-19
"""Height above a surface at which rays begin, as a fraction of the largest coordinate of its triangle.

Hit points and casters' tests err by a few 2^-24 of the largest coordinate (tests/engine/terms/surfaces).
"""

SLIVER, LONG, MOST = 16.0, 64.0, 1024.0
"""A triangle is thin if its longest edge L is over SLIVER times its height H. Its offset is at least 2^-25 L^2 / H, as
OFFSET L min(L / (LONG H), MOST). Its hit points are as exact as others, but casters take the normal as a product of two
edges, rounded by 2^-24: in a flat cap it lifts the plane by 2^-26 L^2 / H at its ends, in a needle not at all.
Barycentrics err as well: points move along it by up to 2^-24 L^2 / H, and by a twentieth of that on average."""

INSET = 2.0
"""Rays begin at least this many offsets inside the triangle's edges.

In an acute concave corner, a point above one wall and next to the edge may lie behind the other wall. With this inset
it lies in front for dihedral angles down to atan(1 / INSET) = 27 degrees.
"""


def offset_and_inset(
    p: Floats64, lengths: Floats64, twice_area: Floats64
) -> tuple[Floats64, Floats64, Indices]:
    """Offsets (T,) at which rays begin, minimum barycentrics (3, T) of their origins, and which triangles are thin.

    Parameters
    ----------
    p : (3, 3, T) corners
    lengths : (3, T) of the edges opposite the corners 0, 1 and 2
    twice_area : (T,)
    """
    offset = OFFSET * np.abs(p).max(axis=(0, 1), initial=0)
    longest = lengths.max(axis=0, initial=0)
    thin = np.flatnonzero(longest * longest > SLIVER * twice_area)
    offset[thin] = np.maximum(offset[thin], raised(longest[thin], twice_area[thin]))
    # A barycentric is the distance from the edge / height, and height = twice the area / edge length.
    return offset, np.minimum(INSET * offset * lengths / twice_area, 1 / 3), thin


def raised(longest: Floats64, twice_area: Floats64) -> Floats64:
    """Least offsets (T,) of thin triangles by their longest edges, see ``SLIVER``."""
    return OFFSET * longest * np.minimum(longest * longest / (LONG * twice_area), MOST)


def pull_off_edges(
    triangles: Triangles, p: Floats32, triangle: Numbers, u: Floats32, v: Floats32, widest: Floats32
) -> None:
    """Move points next to an edge inwards, at right angles to it, in place."""
    w = 1 - u
    w -= v
    smallest = np.minimum(u, v)
    np.minimum(smallest, w, out=smallest)
    # Most points are farther inside than the triangle's largest inset; only the others look up all three.
    near = np.flatnonzero(smallest < widest)
    inset = gather(triangles.inset, triangle.take(near))
    close = (w.take(near) < inset[0]) | (u.take(near) < inset[1]) | (v.take(near) < inset[2])
    near, inset = near[close], inset[:, close]
    if len(near) == 0:
        return
    edges = triangles.edges[triangle.take(near), :6].T.astype(np.float64)
    e1, e2 = edges[:3], edges[3:]
    ng = triangles.planes[triangle.take(near), 3:6].T.astype(np.float64)
    twice_area = dot(cross(e1, e2), ng)
    moved = p[:, near].astype(np.float64)
    for edge, barycentric, least in zip((e2 - e1, -e2, e1), (w, u, v), inset, strict=True):
        # The point moves by `lacking` times the triangle's height, which is twice the area / |edge|. The vector
        # cross(ng, edge) points inwards and has the length |edge|.
        lacking = np.maximum(least - barycentric.take(near), 0)
        moved += cross(ng, edge) * (lacking * twice_area / dot(edge, edge))
    p[:, near] = moved


def bulge(triangles: Triangles, hits: Hits, which: Indices) -> Floats32:
    """Height (m,) float32 >= 0 of the bulge above hits ``which`` (m,), on the incoming side."""
    assert triangles.bulge is not None
    u, v = hits.u.take(which), hits.v.take(which)
    w = 1 - u - v
    height = dot(
        gather(triangles.bulge, hits.triangle.take(which)), np.stack((w * u, w * v, u * v))
    )
    height *= hits.side.take(which)
    return np.maximum(height, 0, out=height)
