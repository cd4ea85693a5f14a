"""Normal maps and bump maps: shading normals from a picture or from noise.

A normal map has them in the frame of its places on the surface.

A colour c means the direction 2 c - 1: red along growing u, green along growing v, blue along the normal. (J. Cohen,
M. Olano and D. Manocha, "Appearance-preserving simplification", 1998.) The frame is that of the triangle's own u and v,
with u at right angles to the shading normal.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.engine.core.hits import Hits, turn_to_viewer
from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats32, Floats64
from course.engine.core.vectors import cross, dot, gather
from course.engine.terms.surfaces.painting import Painting
from course.engine.terms.surfaces.textures import Places, Texture

STEP = np.float32(0.125)
"""How far, in edges of its triangle, a place is compared with its neighbours."""

SHORTEST = 1e-12
"""Square of the shortest of what has a direction: places that don't change along a surface give it none."""


@dataclass(frozen=True)
class NormalMap:
    """A picture of normals on a shape.

    Attributes
    ----------
    color : the picture
    places : where the shape has them
    wraps : true if u goes around, from 1 to 0
    """

    color: Texture
    places: Places
    wraps: bool

    def normals(
        self, weights: Floats32, corners: Floats32, normal: Floats32, edges: Floats32
    ) -> Floats32:
        """Normals (3, n) in the place of shading normals; edges (6, n) go from corner 0 to 1, and to 2."""
        place, first, second = self.changes(weights, corners)
        return _turned(self.color(place), normal, edges[0:3], edges[3:6], first, second)

    def changes(self, weights: Floats32, corners: Floats32) -> tuple[Floats32, Floats32, Floats32]:
        """Places (2, n) at barycentrics, and how they change along the edges from corner 0 to 1, and to 2."""
        here = self.places(weights, corners)
        found = []
        for corner in (1, 2):
            moved = weights.copy()
            moved[0] -= STEP
            moved[corner] += STEP
            change = self.places(moved, corners) - here
            if self.wraps:
                change[0] -= np.round(change[0])
            found.append(change / STEP)
        return here, found[0], found[1]


@dataclass(frozen=True)
class Relief:
    """The normal maps of a surface.

    ``maps``: a `Painting` whose functions are normal maps.
    """

    maps: Painting

    def normals(self, hits: Hits, triangles: Triangles, turned: bool) -> Floats32:
        """Shading normals (3, n) of hits, on the incoming side; ``hits.ns`` where there is no map.

        ``turned`` : true to turn those of maps to the viewer (``turn_to_viewer``)
        """
        ns = hits.ns
        for which, normal_map, weights, corners in self.maps.painted(hits.triangle, hits.u, hits.v):
            if ns is hits.ns:
                ns = ns.copy()
            known: Any = normal_map
            edges = gather(triangles.edges, hits.triangle.take(which))
            side = hits.side.take(which)
            outward = hits.ns.take(which, axis=1) * side
            normals = known.normals(weights, corners, outward, edges) * side
            if turned:
                turn_to_viewer(normals, hits.direction.take(which, axis=1))
            ns[:, which] = normals
        return ns


def _turned(
    color: Floats32,
    normal: Floats32,
    edge_1: Floats32,
    edge_2: Floats32,
    change_1: Floats32,
    change_2: Floats32,
) -> Floats32:
    """Normals (3, n) of a map; the edges (3, n) of the triangles change u and v (2, n) by so much."""
    # Along the surface, with u alone growing, and with v alone; the sign of the determinant is that of the frame.
    # In double precision, for small triangles' products of lengths underflow.
    e1, e2, d1, d2 = (values.astype(np.float64) for values in (edge_1, edge_2, change_1, change_2))
    sign = np.sign(d1[0] * d2[1] - d2[0] * d1[1])
    along_u = _unit((e1 * d2[1] - e2 * d1[1]) * sign)
    along_v = (e2 * d1[0] - e1 * d2[0]) * sign
    along_u -= normal * dot(normal, along_u)
    flat = dot(along_u, along_u) <= SHORTEST
    along_u = _unit(along_u)
    across = cross(normal, along_u)
    across *= np.where(dot(across, along_v) < 0, -1, 1)
    x, y, z = 2 * color - 1
    turned = along_u * x + across * y + normal * z
    flat |= dot(turned, turned) <= SHORTEST
    return np.where(flat, normal, _unit(turned)).astype(np.float32)


def _unit(v: Floats64) -> Floats64:
    """Vectors (3, n) by their lengths; 0 stays 0."""
    unit: Floats64 = v / np.sqrt(np.maximum(dot(v, v), 1e-290))
    return unit
