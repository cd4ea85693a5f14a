"""Where the unit scene is put: turned, scaled by k, moved. Every length, position and intensity goes through here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.formats.meshes.transforms import rotate

AXIS = (1.0, 2.0, 3.0)
AWAY = np.array([1.0, -0.7, 0.31])
"""Direction of the offset, its longest component 1."""

Vector = list[float]
Steps = list[dict[str, Any]]


@dataclass(frozen=True)
class Placement:
    """x -> k R x + k offset.

    Attributes
    ----------
    k : half the extent of the scene [units of the scene file]
    away : the offset [extents, which are 2 k]
    degrees : of the turn R about AXIS
    """

    k: float = 1.0
    away: float = 0.0
    degrees: float = 0.0

    @property
    def _turn(self) -> NDArray[np.float64]:
        if self.degrees == 0:
            return np.eye(3)
        return np.asarray(rotate(AXIS, self.degrees)[:3, :3])

    def points(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions (V, 3)."""
        turned = x if self.degrees == 0 else x @ self._turn.T
        return np.asarray(self.k * turned + 2 * self.away * self.k * AWAY)

    def point(self, *x: float) -> Vector:
        """A position."""
        return [float(v) for v in self.points(np.array([x], float))[0]]

    def vector(self, *x: float) -> Vector:
        """A difference of positions, or a velocity."""
        return [self.k * v for v in self.direction(*x)]

    def direction(self, *x: float) -> Vector:
        """A direction, its length kept."""
        return [float(v) for v in self._turn @ np.array(x, float)]

    def length(self, x: float) -> float:
        """A length."""
        return self.k * x

    def intensity(self, x: float) -> float:
        """An intensity, which counts per squared length."""
        return self.k * self.k * x

    def steps(self, *x: float) -> Steps:
        """The `transform` of a shape whose own sizes are scaled already."""
        moved: Steps = [{"translate": self.point(*x)}]
        return [self.turned(), *moved] if self.degrees else moved

    def turned(self) -> dict[str, Any]:
        """The step of the turn."""
        return {"rotate": {"axis": list(AXIS), "degrees": self.degrees}}

    def normals(self, n: NDArray[np.float64]) -> NDArray[np.float64]:
        """Unit normals (V, 3)."""
        return n if self.degrees == 0 else np.asarray(n @ self._turn.T)
