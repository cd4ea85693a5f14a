"""Where a medium is: in a box that lies along the axes, or in a ball; where rays are in it, and what it overlaps."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Floats64


@dataclass(frozen=True)
class Box:
    """``low``, ``high``: (3,) float32, its corners; infinite where it has no end."""

    low: Floats32
    high: Floats32

    def between(self, origin: Floats32, direction: Floats32) -> tuple[Floats32, Floats32]:
        """Distances (n,) at which rays (3, n) with unit ways come in and go out; for others the second is no more."""
        with np.errstate(divide="ignore", invalid="ignore"):
            one = (self.low[:, None] - origin) / direction
            other = (self.high[:, None] - origin) / direction
            # Not a number: the box has no end there, or the ray goes along it; or it lies in a face.
            bounds = ~np.isnan(one + other)
        first = np.minimum(one, other).max(axis=0, initial=0, where=bounds)
        return first, np.maximum(one, other).min(axis=0, initial=np.inf, where=bounds)


@dataclass(frozen=True)
class Ball:
    """``center``: (3,) float32; ``radius`` above 0."""

    center: Floats32
    radius: float

    def between(self, origin: Floats32, direction: Floats32) -> tuple[Floats32, Floats32]:
        """See ``Box``."""
        # In double precision: the difference of squares of what is far away is small.
        to_center = self.center[:, None].astype(np.float64) - origin
        way = direction.astype(np.float64)
        middle = np.einsum("cn,cn->n", to_center, way)
        aside = to_center - middle * way
        squared = self.radius**2 - np.einsum("cn,cn->n", aside, aside)
        half = np.sqrt(np.maximum(squared, 0))
        first = np.maximum(middle - half, 0).astype(np.float32)
        return first, (middle + half).astype(np.float32)


Corners = Floats64
"""(2, 3), the lowest and the highest corner of a box, infinite where it has no end."""

Sphere = tuple[Floats64, float]
"""Middle (3,) and radius."""


def overlap(one: Corners | Sphere, other: Corners | Sphere) -> bool:
    """Whether there is room in both."""
    if isinstance(one, tuple) and isinstance(other, tuple):
        return bool(np.linalg.norm(one[0] - other[0]) < one[1] + other[1])
    if isinstance(one, tuple):
        return overlap(other, one)
    if isinstance(other, tuple):
        center, radius = other
        nearest = np.clip(center, *one)
        return bool(np.linalg.norm(nearest - center) < radius)
    return bool((np.maximum(one[0], other[0]) < np.minimum(one[1], other[1])).all())
