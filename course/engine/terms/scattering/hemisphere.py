"""Directions about an axis, for the engine's own use: cosine-weighted, or uniform in a cone."""

import numpy as np

from course.engine.core.types import Floats32


def cosine_directions(normal: Floats32, u: Floats32) -> Floats32:
    """Unit directions with density cos / pi about each normal, (3, N).

    A uniform point of the disk is lifted to the hemisphere (Malley).

    Parameters
    ----------
    normal : (3, N) float32, unit length
    u : (2, N) float32 in [0, 1)
    """
    phi = np.float32(2 * np.pi) * u[1]
    radius = np.sqrt(u[0])
    return turned(normal, radius * np.cos(phi), radius * np.sin(phi), np.sqrt(1 - u[0]))


def cone_directions(axis: Floats32, opening: Floats32, u: Floats32) -> tuple[Floats32, Floats32]:
    """Unit directions, uniform in the solid angle of a cone about each axis, and the squared sine of their angle.

    The cosine falls from 1 to 1 - opening, evenly with u[0] (Archimedes).

    Parameters
    ----------
    axis : (3, N) float32, unit length
    opening : (N,) float32, 1 minus the cosine of the half angle, which keeps its digits where cones are narrow
    u : (2, N) float32 in [0, 1)

    Returns
    -------
    (3, N) and (N,) float32
    """
    phi = np.float32(2 * np.pi) * u[1]
    fallen = opening * u[0]
    squared_sine = fallen * (2 - fallen)
    sine = np.sqrt(squared_sine)
    return turned(axis, sine * np.cos(phi), sine * np.sin(phi), 1 - fallen), squared_sine


def turned(axis: Floats32, p: Floats32, q: Floats32, height: Floats32) -> Floats32:
    """Vectors with these coordinates, the last along the axis (3, N); tangents without a branch (Duff et al. 2017).

    Parameters
    ----------
    axis : (3, N) float32, unit length
    p, q, height : (N,) float32
    """
    x, y, z = axis
    sign = np.copysign(np.float32(1), z)
    a = -1 / (sign + z)
    b = x * y * a
    direction: Floats32 = axis * height
    direction[0] += p * (1 + sign * x * x * a) + q * b
    direction[1] += p * (sign * b) + q * (sign + y * y * a)
    direction[2] -= p * (sign * x) + q * y
    return direction
