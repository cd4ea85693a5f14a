"""Tubes about closed curves: the ring torus and the torus knots; y is the axis.

u runs along the curve, v around the tube. At each point c of the curve, n and b are unit vectors
orthogonal to it and to each other, and the tube is c + tube (cos(2 pi v) n + sin(2 pi v) b), whose
normal is that same sum, whichever way n and b turn along the curve.
"""

import math

import numpy as np
from numpy.typing import NDArray

from course.engine.shapes.grid import circle, lattice_triangles, lattice_uv, normalised
from course.engine.shapes.mesh import Mesh

Array = NDArray[np.float64]


def torus(radius: float = 1.0, tube: float = 0.25, segments: int = 96, sides: int = 48) -> Mesh:
    """Return a ring torus about the y axis.

    Parameters
    ----------
    radius : from the centre to the middle of the tube [m], > 0
    tube : radius of the tube [m], 0 < tube < radius
    segments, sides : steps along the tube and around it, 3 to 4096
    """
    cosine, sine = circle(segments)
    outwards = np.stack([cosine, np.zeros(segments + 1), -sine], axis=1)
    upwards = np.tile([0.0, 1.0, 0.0], (segments + 1, 1))
    return _sweep(radius * outwards, outwards, upwards, tube, sides)


def torus_knot(
    p: int = 2,
    q: int = 3,
    radius: float = 1.0,
    tube: float = 0.2,
    segments: int = 512,
    sides: int = 32,
) -> Mesh:
    """Return a tube along the (p, q) torus knot, which winds p times around the y axis.

    The knot lies on a torus of radii `radius` and `radius` / 2, and winds q times around its tube.
    Raises ValueError for a tube that is too thick; the message tells the limit.

    Parameters
    ----------
    p, q : 1 to 32, without a common divisor
    radius : from the centre to the middle of the torus [m], > 0
    tube : radius of the tube along the knot [m], > 0, small enough that the tube meets itself nowhere
    segments : steps along the knot, 8 (p + q) to 16384
    sides : steps around the tube, 3 to 1024
    """
    thickest = radius * thickest_tube(p, q)
    if tube >= thickest:
        raise ValueError(
            f"tube is {tube:g}: expected less than {thickest:.4g}, "
            "where the tube of this knot begins to meet itself"
        )
    turn = np.arange(segments, dtype=np.float64) * (2.0 * math.pi / segments)
    curve, tangent, _, normal = _knot(p, q, turn)
    binormal = np.cross(normal, normalised(tangent))
    curve, normal, binormal = (
        np.concatenate([rows, rows[:1]]) for rows in (radius * curve, normal, binormal)
    )
    return _sweep(curve, normal, binormal, tube, sides)


def thickest_tube(p: int, q: int) -> float:
    """Return how thick a tube along the (p, q) knot of radius 1 may get before it meets itself.

    That is the smaller of the least radius of curvature and half the least distance between two
    points of the knot with at least pi such radii of arc between them: strands that pass each
    other, not neighbours (Litherland, Simon, Durumeric, Rawdon, "Thickness of knots", 1999). The
    curve is sampled, to about 0.1%.
    """
    steps = 64 * (p + q)
    turn = np.arange(steps, dtype=np.float64) * (2.0 * math.pi / steps)
    curve, first, second, _ = _knot(p, q, turn)
    speed = np.sqrt(np.sum(first * first, axis=1))
    turning = np.cross(first, second)
    bend = float(np.min(speed**3 / np.sqrt(np.sum(turning * turning, axis=1))))
    arc = np.cumsum(speed) * (2.0 * math.pi / steps)
    # Of the arc that follows a point, the part whose ends are both far from it; each pair is looked at once.
    begin = np.searchsorted(arc, arc + math.pi * bend)
    end = np.searchsorted(arc, arc + (arc[-1] - math.pi * bend), side="right")
    strands, places = math.inf, np.ascontiguousarray(curve.T)
    for i in range(steps):
        far = places[:, begin[i] : end[i]] - places[:, i, None]
        if far.size:
            strands = min(strands, float((far * far).sum(axis=0).min()))
    return min(bend, 0.5 * math.sqrt(strands))


def _knot(p: int, q: int, turn: Array) -> tuple[Array, Array, Array, Array]:
    """Return the knot of radius 1 at parameters `turn` (N,), two derivatives, the torus' normal."""
    a, b = p * turn, q * turn
    cos_a, sin_a, cos_b, sin_b = np.cos(a), np.sin(a), np.cos(b), np.sin(b)
    rho, rho1, rho2 = 1.0 + 0.5 * cos_b, -0.5 * q * sin_b, -0.5 * q * q * cos_b
    point = np.stack([rho * cos_a, 0.5 * sin_b, -rho * sin_a], axis=1)
    first = np.stack(
        [rho1 * cos_a - rho * p * sin_a, 0.5 * q * cos_b, -rho1 * sin_a - rho * p * cos_a], axis=1
    )
    second = np.stack(
        [
            (rho2 - rho * p * p) * cos_a - 2.0 * rho1 * p * sin_a,
            -0.5 * q * q * sin_b,
            -(rho2 - rho * p * p) * sin_a - 2.0 * rho1 * p * cos_a,
        ],
        axis=1,
    )
    normal = np.stack([cos_b * cos_a, sin_b, -cos_b * sin_a], axis=1)
    return point, first, second, normal


def _sweep(curve: Array, n: Array, b: Array, tube: float, sides: int) -> Mesh:
    """Return the tube about a closed curve; curve, n, b are (M + 1, 3), the last row the first."""
    segments = len(curve) - 1
    cosine, sine = circle(sides)
    # Products and sums alone: equal bits in give equal bits out, wherever they stand in the array.
    normals = cosine[:, None, None] * n + sine[:, None, None] * b
    vertices = curve + tube * normals
    return Mesh(
        vertices=vertices.reshape(-1, 3),
        triangles=lattice_triangles(segments, sides),
        normals=normals.reshape(-1, 3),
        uv=lattice_uv(segments, sides),
    )
