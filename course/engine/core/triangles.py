"""All triangles of a scene as float32 tables, one row per triangle.

The scene was moved and scaled to [-1, 1] in float64, before it was rounded to float32.

Symbols: p0, p1, p2 corners; e1 = p1 - p0, e2 = p2 - p0; ng geometric normal; n0, n1, n2 corner normals;
u, v barycentrics of p1 and p2, w = 1 - u - v.

If a mesh has been scaled non-uniformly, its corner normals differ in length. They are interpolated first and
normalised last, which gives the normals of the stretched surface: those of an ellipsoid if it was a sphere.
"""

from dataclasses import dataclass

from course.engine.core.types import Floats32, Materials


@dataclass(frozen=True)
class Triangles:
    """T triangles.

    Attributes
    ----------
    planes : (T, 8) float32, p0, ng (unit), the offset of leaving rays, and 1 if ng is also the shading normal, else 0
    edges : (T, 8) float32, e1, e2, the largest inset, and padding: NumPy gathers rows of 32 bytes twice as fast as
        rows of 24 or 36
    inset : (T, 3) float32, the smallest w, u and v at which rays begin; points beyond are moved inwards
    corner_normals : (T, 9) float32, n0, n1 - n0, n2 - n0, where the longest of n0, n1, n2 has length 1; None if no part
        has normals
    bulge : (T, 3) float32, k01 / 2, k02 / 2, k12 / 2 of ``course.engine.core.ray_offset``; None if no part has
        normals, or if shadow rays ignore the bulge
    largest_sine : sine of the largest angle between ng and a corner normal, 0 if every triangle is flat-shaded
    material : (T,) uint16 material numbers
    parts : (number of vertices, number of triangles, true if convex) of each object, in the order of the triangles
    largest_raised : largest offset of thin triangles (``course.engine.core.ray_offset``), 0 if there are none
    """

    planes: Floats32
    edges: Floats32
    inset: Floats32
    corner_normals: Floats32 | None
    bulge: Floats32 | None
    largest_sine: float
    material: Materials
    parts: tuple[tuple[int, int, bool], ...] = ()
    largest_raised: float = 0.0
