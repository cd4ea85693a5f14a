"""Shapes by name, each a function that returns a `Mesh` with smooth normals and uv.

All are centred at the origin with y up; u cross v points outwards everywhere, so that no texture is
mirrored. Closed shapes are watertight bit for bit: vertices that differ in normal or uv but not in
place have identical coordinates. Parameters out of range raise ValueError.
"""

from __future__ import annotations

from course.shapes.capped import cone, cylinder
from course.shapes.flat import box, disk, quad
from course.shapes.spheres import displaced_sphere, sphere
from course.shapes.terrain import height_field
from course.shapes.tubes import torus, torus_knot

__all__ = [
    "box",
    "cone",
    "cylinder",
    "disk",
    "displaced_sphere",
    "height_field",
    "quad",
    "sphere",
    "torus",
    "torus_knot",
]
