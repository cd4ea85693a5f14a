"""Supersampling by contrast: pixels whose corners differ are divided into four, and so are their parts.

Whitted, "An improved illumination model for shaded display", 1980. A level of cells is decided on at once: rays
through the corners that are new, `needs_subdivision` for all cells, `subdivide` for those that do. A pixel's colour is
the mean of its cells' corners, each cell counting by its area. What has been seen decides alone, between the levels,
so the picture doesn't depend on the threads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.core.types import Floats32, Floats64, Indices, Mask
from course.effects import Bound
from course.errors import EffectError
from course.imaging.film import Film
from course.rendering.adaptive import Run
from course.rendering.corners import Corners
from course.scene.world import Subdivision

SUBDIVIDE = "adaptive_sampling.subdivide"
_SIDES = ("x0", "y0", "x1", "y1")


@dataclass(frozen=True)
class Cells:
    """Cells of one level.

    Attributes
    ----------
    sides : (4, n) float32, x0, y0, x1, y1 of each [pixels]
    pixel : (n,) intp, number of the pixel that each is part of
    """

    sides: Floats32
    pixel: Indices

    def chosen(self, which: Mask) -> Cells:
        """Those of a mask (n,)."""
        return Cells(self.sides[:, which], self.pixel[which])


@dataclass(frozen=True)
class Saving:
    """What became of the rays.

    Attributes
    ----------
    shot : corners that got rays
    shared : corners of cells that had them already, from a neighbour or from the cell that was divided
    lattice : corners of the smallest cells, had all pixels been divided
    """

    shot: int
    shared: int
    lattice: int

    def to_dict(self) -> dict[str, float]:
        """For the receipt; ``saved`` is the part of the lattice that got no rays."""
        return {
            "corners": self.shot,
            "shared": self.shared,
            "lattice": self.lattice,
            "saved": 1.0 - self.shot / self.lattice,
        }


class Functions:
    """The module's functions, with a look at what they return.

    Raises
    ------
    EffectError
        A function is missing, or returns what the renderer can't go on with.
    """

    def __init__(self, bound: Bound, rule: Subdivision) -> None:
        asked_by = ("film", "subdivision")
        self._needs = bound.function("adaptive_sampling", "needs_subdivision", asked_by)
        self._subdivide: Callable[..., Any] | None = None
        if rule.depth:
            self._subdivide = bound.function("adaptive_sampling", "subdivide", asked_by)
        # Corners are float32: beyond its range a number can't even be compared with them.
        self._threshold = min(rule.threshold, float(np.finfo(np.float32).max))

    def divides(self, corners: Floats32) -> Mask:
        """(n,) which cells to divide, by their corners (3, 4, n)."""
        chosen: Mask = self._needs(corners, self._threshold)
        return chosen

    def children(self, cells: Cells) -> Cells:
        """Four for each cell."""
        assert self._subdivide is not None
        sides = np.stack(self._subdivide(*cells.sides))
        x0, y0, x1, y1 = cells.sides
        ends = np.stack((x0, x1)), np.stack((y0, y1))
        for name, side, (low, high) in zip(_SIDES, sides, ends * 2, strict=True):
            # Halves of powers of two: exact.
            middle = 0.5 * (low + high)
            wrong = (side != low) & (side != middle) & (side != high)
            if wrong.any():
                child, cell = np.argwhere(wrong)[0]
                raise EffectError(
                    f"{SUBDIVIDE}: {name} of child {child} is {side[child, cell]:g} in a cell from "
                    f"{low[cell]:g} to {high[cell]:g}, expected an end of the cell or its middle"
                )
        return Cells(sides.reshape(4, -1), np.tile(cells.pixel, 4))


def render_subdivided(
    corners: Corners, film: Film, functions: Functions, depth: int, run: Run
) -> tuple[bool, Saving]:
    """Divide pixels by contrast and write their colours into the film; whether all was done, and what it took."""
    total = np.zeros((3, film.width * film.height))
    cells, undecided = _pixels(film.width, film.height), None
    asked = 0
    complete = True
    for level in range(depth + 1):
        x0, y0, x1, y1 = cells.sides
        numbers = corners.numbers(np.stack((x0, x1, x0, x1)), np.stack((y0, y0, y1, y1)))
        work = corners.begin_round(numbers)
        complete = run(work, level / (depth + 1), (level + 1) / (depth + 1))
        if not complete:
            break
        asked += numbers.size
        corners.end_round()
        radiance = corners.radiance(numbers)
        divided = np.zeros(numbers.shape[1], np.bool_)
        if level < depth:
            divided = functions.divides(radiance)
        _add(total, cells.chosen(~divided), radiance[:, :, ~divided])
        undecided = cells.chosen(divided), radiance[:, :, divided]
        if not divided.any():
            break
        cells = functions.children(undecided[0])
    if not complete and undecided is not None:
        # The level that wasn't finished counts as not begun.
        _add(total, *undecided)
    film.linear[:] = total.reshape(film.linear.shape)
    film.samples[:] = corners.rays_by_pixel()
    return complete, Saving(corners.size, asked - corners.size, corners.lattice)


def _pixels(width: int, height: int) -> Cells:
    """Each pixel as a cell."""
    y, x = np.divmod(np.arange(width * height), width)
    sides = np.stack((x, y, x + 1, y + 1)).astype(np.float32)
    return Cells(sides, np.arange(width * height))


def _add(total: Floats64, cells: Cells, radiance: Floats32) -> None:
    """Add cells to their pixels (3, P): the mean of the corners (3, 4, n), by area."""
    x0, y0, x1, y1 = cells.sides.astype(np.float64)
    area = 0.25 * (x1 - x0) * (y1 - y0)
    for channel, values in zip(total, radiance, strict=True):
        share = values.sum(axis=0, dtype=np.float64) * area
        channel += np.bincount(cells.pixel, share, minlength=len(channel))
