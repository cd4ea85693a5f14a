"""Supersampling by contrast: pixels whose corners differ are divided into four, and so are their parts.

Whitted, "An improved illumination model for shaded display", 1980. All cells of a level are decided together: rays
through the new corners, `needs_subdivision` for all cells, `subdivide` for those that need it. A pixel's colour is the
mean of its cells' corners, weighted by the cells' areas. Decisions are made between levels, from colours alone, so the
picture doesn't depend on the threads.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.base.errors import CourseError, EffectError
from course.engine.core.schedule import Executor, Run, Schedule
from course.engine.core.tracer import Tracer
from course.engine.core.types import Floats32, Floats64, Indices, Mask
from course.engine.functions.effects import Bound
from course.engine.render.adaptive.corners import CornerFilm
from course.engine.render.job import Job, Mode
from course.engine.scene.scene import Subdivision

BYTES_A_PIXEL = 400
"""Cells, their corners and what is known of them; measured, 350 or less."""

SUBDIVIDE = "adaptive_sampling.subdivide"
_SIDES = ("x0", "y0", "x1", "y1")


@dataclass(frozen=True)
class LevelCells:
    """Cells of one level.

    Attributes
    ----------
    sides : (4, n) float32, x0, y0, x1, y1 of each [pixels]
    pixel : (n,) intp, number of the pixel that each is part of
    """

    sides: Floats32
    pixel: Indices

    def chosen(self, which: Mask) -> "LevelCells":
        """Those of a mask (n,)."""
        return LevelCells(self.sides[:, which], self.pixel[which])


class SubdivisionFunctions:
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

    def children(self, cells: LevelCells) -> LevelCells:
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
                    f"{SUBDIVIDE}: {name} of child {child} is {side[child, cell]:.9g} in a cell from "
                    f"{low[cell]:.9g} to {high[cell]:.9g}, expected an end of the cell or its middle"
                )
        return LevelCells(sides.reshape(4, -1), np.tile(cells.pixel, 4))


class SubdivisionSchedule(Schedule):
    """A round for each level: pixels are divided by contrast, and their colours written into the film.

    The picture is covered once the corners of all pixels have had their rays.

    Parameters
    ----------
    depth : how many times a pixel may be divided
    """

    def __init__(self, film: CornerFilm, functions: SubdivisionFunctions, depth: int) -> None:
        self._film = film
        self._functions = functions
        self._depth = depth

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        complete = self._divide(run)
        # A ray through a corner draws no place in a pixel.
        executor.counters.numbers.pop("pixel", None)
        return complete

    def receipt(self) -> dict[str, Any]:
        """The rays that were cast; ``saved`` is the share of the lattice without a ray."""
        film = self._film
        return {
            "subdivision": {
                "corners": film.size,
                "shared": film.shared,
                "lattice": film.lattice,
                "saved": 1.0 - film.size / film.lattice,
            }
        }

    def _divide(self, run: Run) -> bool:
        film, levels = self._film, self._depth + 1
        total = np.zeros((3, film.width * film.height))
        cells, undecided = _pixels(film.width, film.height), None
        complete = True
        for level in range(levels):
            x0, y0, x1, y1 = cells.sides
            numbers = film.numbers(np.stack((x0, x1, x0, x1)), np.stack((y0, y0, y1, y1)))
            complete = run(film.begin_round(numbers), level / levels, (level + 1) / levels)
            if not complete:
                break
            film.end_round()
            radiance = film.radiance(numbers)
            divided = np.zeros(numbers.shape[1], np.bool_)
            if level < self._depth:
                divided = self._functions.divides(radiance)
            _add(total, cells.chosen(~divided), radiance[:, :, ~divided])
            undecided = cells.chosen(divided), radiance[:, :, divided]
            if not divided.any():
                break
            cells = self._functions.children(undecided[0])
        if not complete and undecided is not None:
            # The level that wasn't finished counts as not begun.
            _add(total, *undecided)
        film.linear[:] = total.reshape(film.linear.shape)
        film.count_rays()
        return complete


def check(job: Job) -> None:
    """See ``Mode``: what places samples in pixels, or leaves them off, doesn't go with rays through corners."""
    settings, loaded = job.settings, job.scene.loaded
    where = f"{loaded.document.where(('film', 'subdivision'))}: film.subdivision"
    if settings.error is not None:
        raise CourseError(
            f"{where} sends rays where corners differ, an error where estimates are large; give one of the two"
        )
    if job.time_limit is not None:
        raise CourseError(
            f"{where} ends when no cell needs dividing and not by a time limit; a lower depth takes less time"
        )
    if settings.sampler != "sobol":
        raise CourseError(
            f"{where} places its rays by itself; the {settings.sampler} sampler has nothing to place, use sobol"
        )
    if loaded.description.film.filter != "box":
        raise CourseError(f"{where} weighs cells by their area; film.filter must be box")


def make(job: Job, _tracer: Tracer, bound: Bound) -> tuple[CornerFilm, SubdivisionSchedule]:
    """See ``Mode``."""
    settings, rule = job.settings, job.settings.subdivision
    assert rule is not None
    film = CornerFilm(settings.width, settings.height, rule.depth, settings.samples)
    return film, SubdivisionSchedule(film, SubdivisionFunctions(bound, rule), rule.depth)


SUBDIVISION = Mode(make, check, BYTES_A_PIXEL, "a picture by subdivision")


def _pixels(width: int, height: int) -> LevelCells:
    """Each pixel as a cell."""
    y, x = np.divmod(np.arange(width * height), width)
    sides = np.stack((x, y, x + 1, y + 1)).astype(np.float32)
    return LevelCells(sides, np.arange(width * height))


def _add(total: Floats64, cells: LevelCells, radiance: Floats32) -> None:
    """Add cells to their pixels (3, P): the mean of the corners (3, 4, n), by area."""
    x0, y0, x1, y1 = cells.sides.astype(np.float64)
    area = 0.25 * (x1 - x0) * (y1 - y0)
    for channel, values in zip(total, radiance, strict=True):
        share = values.sum(axis=0, dtype=np.float64) * area
        channel += np.bincount(cells.pixel, share, minlength=len(channel))
