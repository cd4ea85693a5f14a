"""Where the points of a light may lie: the far ends of shafts."""

from typing import NamedTuple

import numpy as np

from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import RAISED, TO_THE_LIGHT, Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats32, Floats64, Mask
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.shafts.cells import ROOM


class LampRegion(NamedTuple):
    """A ball, or a box with any three edges, or both added up, in which all points of a light lie.

    Attributes
    ----------
    middle : (3,) float64; of a light infinitely far away the direction to it
    half : (3, 3) float64, half of each edge; rows of zeros for edges that it hasn't
    radius : of the ball
    limit : length of shadow rays in lengths of the way to the light
    far : true if it is infinitely far away
    """

    middle: Floats64
    half: Floats64
    radius: float
    limit: float
    far: bool


def lamp_of(light: Light) -> LampRegion | None:
    """The light's points; None for a light of another kind, or one to which rays go on behind it."""
    if type(light) is DirectionalLight:
        return LampRegion(light.to_light.astype(np.float64), np.zeros((3, 3)), 0.0, 1.0, far=True)
    lamp = _near(light)
    if lamp is None or light.limit >= TO_THE_LIGHT:
        return None
    middle, half, radius = lamp
    if light.velocity is not None:
        # What it sweeps while the shutter is open, as a box along the axes.
        way = light.velocity.astype(np.float64) / 2
        middle, half = middle + way, np.diag(np.abs(half).sum(axis=0) + np.abs(way))
    room = 2 * ROOM * max(float(np.abs(middle).max() + np.abs(half).sum() + radius), 1.0)
    if getattr(light, "normal", None) is not None:
        # Rays end above flat lamps.
        room += float(RAISED)
    return LampRegion(middle, half, radius + room, light.limit, far=False)


def _near(light: Light) -> tuple[Floats64, Floats64, float] | None:
    none = np.zeros((3, 3))
    if type(light) is PointLight:
        return light.position.astype(np.float64), none, 0.0
    if type(light) is RectangleLight:
        corner, *edges = (
            array.astype(np.float64) for array in (light.corner, light.edge_u, light.edge_v)
        )
        half = np.array((*edges, np.zeros(3))) / 2
        return corner + half.sum(axis=0), half, 0.0
    if type(light) in (SphereLight, VisibleSphereLight):
        return light.center.astype(np.float64), none, float(light.radius)  # type: ignore[attr-defined]
    if type(light) is MeshLight:
        p0 = light.planes[:, :3].astype(np.float64)
        corners = np.concatenate((p0, p0 + light.edges[:, :3], p0 + light.edges[:, 3:6]))
        low, high = corners.min(axis=0), corners.max(axis=0)
        return (low + high) / 2, np.diag((high - low) / 2), 0.0
    return None


def holds(lamp: LampRegion, places: Floats32) -> Mask:
    """Which points (3, n) lie where those of the lamp may; a student's function may put them anywhere."""
    x = places - lamp.middle.astype(np.float32)[:, None]
    if not lamp.half.any():
        return np.asarray(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] <= lamp.radius * lamp.radius)
    # Edges that it hasn't are those of the ball.
    edges = _frame(lamp.half, lamp.radius)
    lengths = np.sqrt((edges * edges).sum(axis=1))
    inverse = np.linalg.inv(edges.T).astype(np.float32)
    # A quarter of the radius by each edge stays within it.
    most = (1 + lamp.radius / (4 * lengths)).astype(np.float32)
    inside = np.ones(places.shape[1], np.bool_)
    for row, limit in zip(inverse, most, strict=True):
        inside &= np.abs(row[0] * x[0] + row[1] * x[1] + row[2] * x[2]) <= limit
    return inside


def _frame(half: Floats64, radius: float) -> Floats64:
    """Three independent edges: those there are, and others at right angles to them, as long as the radius."""
    _, sizes, axes = np.linalg.svd(half)
    # What an edge lacks of being one is the ball's.
    edges = half.copy()
    free = [axis for axis, size in zip(axes, sizes, strict=True) if size <= 1e-9 * sizes[0]]
    for number in np.flatnonzero(~half.any(axis=1))[: len(free)]:
        edges[number] = radius / 4 * free.pop()
    return edges
