"""Lamps in the plane of a surface, as those are that are set in a ceiling: rounding decides which one rays meet.

Rectangles are lifted off the surface, on the side to which they shine. Objects shine to both sides: of them it is told.
"""

import itertools
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.types import Floats64, Indices, Mask
from course.engine.core.vectors import cross, dot
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.scene.building.frame import Frame, bounds_of
from course.engine.scene.building.lights import rectangle_mesh
from course.engine.scene.building.motion import Shutter
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart

SAME, LIFTED = 2.0**-21, 2.0**-20
"""Distance up to which a lamp lies in a surface's plane, and by which it is lifted then: parts of their largest
coordinate. Hits err by a few 2^-24 of it; rays leave surfaces from twice as high as a lamp is lifted."""

OVERLAP = 1e-6
"""Triangles that reach into each other by less than this part of their size have only an edge in common."""

MOST, ALIKE = 1 << 18, 1e-3
"""Pairs of triangles that are compared in one go, and how alike two planes are that may be the same."""


@dataclass(frozen=True)
class _Thing:
    """Triangles in the compiled scene, and how they move."""

    mesh: Mesh
    velocity: tuple[float, float, float]

    @cached_property
    def box(self) -> Floats64:
        """The lowest and the highest corner, (2, 3)."""
        return bounds_of(self.mesh)

    def within(self, low: Floats64, high: Floats64) -> Floats64:
        """The corners (T, 3, 3) of the triangles that reach into a box."""
        if (self.box[1] < low).any() or (self.box[0] > high).any():
            return np.empty((0, 3, 3))
        p: Floats64 = self.mesh.vertices[self.mesh.triangles]
        p = p[((p.max(axis=1) >= low) & (p.min(axis=1) <= high)).all(axis=1)]
        sides = p - np.roll(p, 1, axis=1)
        # What is smaller than rounding, or has no area, meets nothing.
        across = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
        least = SAME * np.maximum(
            np.abs(p).max(axis=(1, 2), initial=0), np.abs(sides).max(axis=(1, 2), initial=0)
        )
        some: Floats64 = p[across > least * least]
        return some


def lifts(
    loaded: Loaded, frame: Frame, shutter: Shutter, parts: Sequence[FullPart]
) -> dict[int, Floats64]:
    """How far lights are moved (3,) in the compiled scene, by their numbers; a CourseWarning for others that overlap.

    ``parts`` : of the objects
    """
    lights = loaded.description.lights
    names = [thing.name for thing in loaded.description.objects]
    things = [_Thing(part.mesh, part.velocity) for part in parts]
    # All things with a place in the file; lamps are compared with each other, too.
    keys: list[tuple[str, int]] = [("objects", number) for number in range(len(things))]
    for number, light in enumerate(lights):
        if isinstance(light, d.RectangleLight) and light.radiance is not None and light.visible:
            mesh = rectangle_mesh(light)
            mesh = frame.mesh(Mesh(mesh.vertices + shutter.start(light.motion), mesh.triangles))
            things.append(_Thing(mesh, shutter.velocity(light.motion, frame)))
            keys.append(("lights", number))
    asked = {key: thing for key, thing in zip(keys, things, strict=True) if key[0] == "lights"}
    for number, light in enumerate(lights):
        if isinstance(light, d.ObjectLight):
            asked["lights", number] = things[names.index(light.object)]
    if not asked:
        return {}
    boxes = np.array([thing.box for thing in things])
    near = SAME * float(np.abs(boxes).max())
    found: dict[int, Floats64] = {}
    for (_, number), lamp in asked.items():
        meets = (boxes[:, 0] <= lamp.box[1] + near) & (boxes[:, 1] >= lamp.box[0] - near)
        turned = isinstance(lights[number], d.RectangleLight)
        normal = _normals(lamp.mesh.vertices[lamp.mesh.triangles[:1]])[0]
        high = 0.0
        for k in np.flatnonzero(meets.all(axis=1)).tolist():
            if things[k] is lamp or not (largest := _largest(lamp, things[k], not turned)):
                continue
            first = things[k].mesh
            other = _normals(first.vertices[first.triangles[:1]])[0]
            if turned and (keys[k][0] == "objects" or normal @ other < 0):
                high = max(high, largest)
            elif keys[k][0] == "objects" or (turned and keys[k][1] < number):
                _warn(loaded, number, "{}[{}]".format(*keys[k]))
                break
        if high:
            found[number] = LIFTED * high * normal
    return found


def _warn(loaded: Loaded, number: int, other: str) -> None:
    warnings.warn(
        f"{loaded.document.where(('lights', number))}: lights[{number}] lies in the plane of {other} and overlaps it:"
        f" which one rays meet is left to rounding; move one of them by {10 * SAME:.0e} of the scene's size or more",
        CourseWarning,
        stacklevel=2,
    )


def _largest(a: _Thing, b: _Thing, any_: bool = False) -> float:
    """The largest coordinate of triangles of two things that lie in one plane and overlap, or of any; 0 for none."""
    if tuple(a.velocity) != tuple(b.velocity):
        return 0.0
    near = SAME * max(np.abs(a.box).max(), np.abs(b.box).max())
    q = b.within(a.box[0] - near, a.box[1] + near)
    if len(q) == 0:
        return 0.0
    p = a.within(q.min(axis=(0, 1)) - near, q.max(axis=(0, 1)) + near)
    largest = 0.0
    for i, j in _alike(p, q):
        one, other = p[i], q[j]
        there = _overlap(one, other) & _in_one_plane(one, other)
        both = np.abs(one[there]).max(initial=0), np.abs(other[there]).max(initial=0)
        largest = max(largest, *map(float, both))
        if any_ and largest:
            break
    return largest


def _alike(p: Floats64, q: Floats64) -> Iterator[tuple[Indices, Indices]]:
    """Pairs of triangles (A, 3, 3) and (B, 3, 3) that may lie in one plane, some at a time."""
    step = max(MOST // max(len(q), 1), 1)
    if len(p) <= step:
        i, j = np.indices((len(p), len(q)))
        yield i.ravel(), j.ravel()
        return
    # Heavy, and only meshes that are lamps need it.
    from scipy.spatial import cKDTree

    of_p, of_q = _normals(p), _normals(q)
    size = float(np.abs(q).max())
    planes = [
        np.column_stack((n, np.einsum("ax,ax->a", n, x[:, 0]) / size))
        for n, x in ((of_p, p), (of_q, q))
    ]
    tree = cKDTree(planes[1])
    for first in range(0, len(p), step):
        for sign in (1, -1):
            some = tree.query_ball_point(sign * planes[0][first : first + step], ALIKE)
            j = np.fromiter(itertools.chain.from_iterable(some), np.intp)
            yield np.repeat(np.arange(len(some)) + first, [len(each) for each in some]), j


def _normals(p: Floats64) -> Floats64:
    """(A, 3) of unit length, 0 of triangles without area."""
    normal = cross((p[:, 1] - p[:, 0]).T, (p[:, 2] - p[:, 0]).T)
    unit: Floats64 = (normal / np.maximum(np.sqrt(dot(normal, normal)), 1e-300)).T
    return unit


def _in_one_plane(p: Floats64, q: Floats64) -> Mask:
    """Of which pairs of triangles (K, 3, 3) one lies in the plane of the other."""
    size = np.maximum(np.abs(p).max(axis=(1, 2)), np.abs(q).max(axis=(1, 2)))
    heights = [
        np.abs(np.einsum("kx,kcx->kc", _normals(a), b - a[:, :1])).max(axis=1)
        for a, b in ((p, q), (q, p))
    ]
    same: Mask = np.minimum(*heights) <= SAME * size
    return same


def _overlap(a: Floats64, b: Floats64) -> Mask:
    """Which pairs of triangles (K, 3, 3) in one plane have an area in common, by the sides that part them."""
    normal = _normals(a)[:, None]
    together = np.ones(len(a), np.bool_)
    for p in (a, b):
        side = np.roll(p, -1, axis=1) - p
        # (K, 3 sides, 3): at right angles to the side, in the plane.
        across = np.cross(np.broadcast_to(normal, side.shape), side)
        reach = [np.einsum("ksx,kcx->ksc", across, q) for q in (a, b)]
        low = np.maximum(reach[0].min(axis=2), reach[1].min(axis=2))
        high = np.minimum(reach[0].max(axis=2), reach[1].max(axis=2))
        size = np.minimum(*(np.ptp(each, axis=2) for each in reach))
        together &= ((high - low > OVERLAP * size) & (size > 0)).all(axis=1)
    return together
