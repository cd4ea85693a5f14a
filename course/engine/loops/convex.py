"""Convex objects: what leaves one outwards can't meet it again, so it need only be looked for among the others.

A finely divided ball is the hardest thing to leave: the ray's origin lies in the boxes of many of its triangles, all
of which are tested, and none can be hit. Where the ball is convex by its making, a ray that leaves it outwards and
passes by the boxes of all other objects meets nothing, and Embree needn't be asked.

This pays where objects are few and stand apart, so it is estimated first how many rays would be spared. Rays are
looked at one by one, so compiled loops alone do it; the answers are the same without.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Floats64, Mask, Numbers
from course.engine.core.vectors import cross, dot
from course.engine.terms.surfaces.boxes import roomy_box

MOST_OBJECTS = 16
"""Objects up to which a ray is held against the box of each."""

LEAST_TRIANGLES = 1000
"""Of an object that is worth being left out; a few triangles cost no more than the boxes."""

WORTH = 0.2
"""Share of the rays that leave an object from which on it pays to look whether they meet another."""

_PROBES, _CANDIDATES = 512, 4096

_NOWHERE = np.full((2, 3), 3e38, np.float32)
"""The box of an object without triangles: no ray gets there."""


@dataclass(frozen=True)
class ConvexObjects:
    """K objects that stand still, of which some are convex.

    Attributes
    ----------
    first : (K + 1,) int32, the first triangle of each, and the number of all
    worth : (K,) bool, whether it is convex, and leaving it out pays
    boxes : (2 K, 3) float32, lowest and highest corner of each, with room for the rounding of Embree's hits
    """

    first: Numbers
    worth: Mask
    boxes: Floats32


def convex_objects(
    vertices: Floats32, triangles: Numbers, parts: Sequence[tuple[int, int, bool]]
) -> ConvexObjects | None:
    """The objects of a scene, or None where there is nothing to be gained.

    Parameters
    ----------
    vertices : (V, 3) float32
    triangles : (T, 3) int
    parts : how many vertices and triangles are each object's, in the order of the arrays, and whether it is convex
    """
    worth = np.array([convex and size >= LEAST_TRIANGLES for _, size, convex in parts], np.bool_)
    if len(parts) > MOST_OBJECTS or not worth.any():
        return None
    first = np.cumsum([0, *(size for _, size, _ in parts)])
    ends = np.cumsum([count for count, _, _ in parts]).tolist()
    boxes = [
        roomy_box(vertices[end - count : end]) if size else _NOWHERE
        for end, (count, size, _) in zip(ends, parts, strict=True)
    ]
    for number in np.flatnonzero(worth).tolist():
        others = [box for other, box in enumerate(boxes) if other != number]
        mine = triangles[first[number] : first[number + 1]]
        worth[number] = _spared(vertices, mine, others) >= WORTH
    if not worth.any():
        return None
    return ConvexObjects(first.astype(np.int32), worth, np.concatenate(boxes))


def _spared(vertices: Floats32, triangles: Numbers, boxes: Sequence[Floats32]) -> float:
    """Share of the rays from a surface, spread by the cosine, that meet none of some boxes."""
    rng = np.random.default_rng(0)
    # Probes are chosen by area, among some triangles: to look at a million would take longer than it may spare.
    some = triangles[rng.integers(len(triangles), size=_CANDIDATES)]
    p = vertices.take(some, axis=0).astype(np.float64).transpose(1, 2, 0)
    normal = cross(p[1] - p[0], p[2] - p[0])
    twice_area = np.sqrt(dot(normal, normal))
    chosen = rng.choice(_CANDIDATES, _PROBES, p=twice_area / twice_area.sum())
    origin = p.mean(axis=0)[:, chosen]
    way = rng.normal(size=origin.shape)
    way = normal[:, chosen] / twice_area[chosen] + way / np.sqrt(dot(way, way))
    free = np.ones(_PROBES, np.bool_)
    for box in boxes:
        free &= ~_meets(origin, way, box)
    return float(free.mean())


def _meets(origin: Floats64, way: Floats64, box: Floats32) -> Mask:
    """Which rays meet a box, by slabs."""
    with np.errstate(divide="ignore", invalid="ignore"):
        a, b = ((corner[:, None] - origin) / way for corner in box.astype(np.float64))
    near, far = np.fmin(a, b).max(axis=0, initial=0), np.fmax(a, b).min(axis=0)
    return np.asarray(near <= far)
