"""Shapes by name, each a function that returns a `Mesh` with smooth normals and uv.

All are centred at the origin with y up; u cross v points outwards everywhere, so that no texture is
mirrored. Closed shapes are watertight bit for bit: vertices that differ in normal or uv but not in
place have identical coordinates. The ranges of their parameters are those of the
scene format (`course.engine.formats.yaml.description`), which checks them.
"""

from course.engine.shapes.curved import displaced_sphere, height_field, sphere
from course.engine.shapes.flat import box, cone, cylinder, disk, quad
from course.engine.shapes.tubes import torus, torus_knot

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
