"""The costs of samples, in units of one camera ray that hits nothing.

Adaptive sampling takes fewer samples where a sample costs more (``course.engine.render.adaptive.allocation``).
Seconds are not used: they differ from run to run, and pictures mustn't.
"""

import numpy as np

from course.engine.core.types import Floats32, Indices

HIT = 1.0
"""Geometry of a hit, and shading without lights."""

SHADOW_RAY = 1.5
"""A point on a light and the shadow ray to it."""

FURTHER_RAY = 5.0
"""A reflected or refracted ray. It is dearer than a camera ray, for its neighbours go in other directions."""


class RowOfCosts:
    """The cost of each path of a block.

    ``row`` (paths,) float32 has the costs so far, ``prices`` are those of a hit, a shadow ray and a further ray.
    """

    prices = HIT, SHADOW_RAY, FURTHER_RAY

    def __init__(self, row: Floats32) -> None:
        self.row = row

    @classmethod
    def of(cls, paths: int) -> "RowOfCosts":
        """The costs of camera rays, one per path."""
        return cls(np.ones(paths, np.float32))

    def add(self, kind: str, path: Indices | None, cost: float | None = None) -> None:
        """Add the cost of a "hit" or of a kind of ray, or ``cost`` itself, to paths (n,) or to all."""
        if cost is None:
            cost = {"hit": HIT, "shadow": SHADOW_RAY}.get(kind, FURTHER_RAY)
        if path is None:
            self.row += np.float32(cost)
        else:
            np.add.at(self.row, path, np.float32(cost))

    def part(self, paths: slice) -> "RowOfCosts":
        """The costs of some of the paths."""
        return RowOfCosts(self.row[paths])

    def with_row(self, mean: Floats32, parts: int) -> Floats32:
        """(4, n * parts) from colours (3, n * parts) of n pixels; the last row is the mean cost of a pixel's paths.

        All parts of a pixel get the same mean: a mean for each part would take more time than it saves.
        """
        pixels = mean.shape[1] // parts
        # np.mean takes four times as long for rows as short as these.
        each = np.einsum("ps->p", self.row.reshape(pixels, -1)) / np.float32(
            len(self.row) // pixels
        )
        return np.concatenate((mean, np.repeat(each, parts)[None]))
