"""The corners of cells: points of a lattice that neighbours share, so that each gets its rays once.

The lattice is that of the smallest cells. A corner's number counts its points row by row, and everything that a ray
through it draws at random depends on that number alone.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.rays import RAYS
from course.engine.core.samplers import Block
from course.engine.core.tiles import Work
from course.engine.core.types import Floats32, Numbers, Words
from course.engine.terms.samplers.sobol import SobolSampler

Numbers64 = NDArray[np.int64]


class CornerSampler(SobolSampler):
    """Sobol points for all that a ray decides but its place in the picture, which is the corner itself."""

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """As for any block; the first pair of dimensions, the place in the pixel, is 0."""
        if dimension == 0:
            return np.zeros((width, block.size), np.float32)
        return super().draw(block, dimension, width)


@dataclass(frozen=True)
class CornerGroup:
    """Some corners that get their rays at once.

    Attributes
    ----------
    number : different for every group of a render
    start : place of the first in the round
    corners_of_lattice : (n,) int64, their numbers
    columns : of the lattice
    scale : side of the smallest cells [pixels]
    """

    number: int
    start: int
    corners_of_lattice: Numbers64
    columns: int
    scale: float

    @property
    def size(self) -> int:
        """Number of corners."""
        return len(self.corners_of_lattice)

    def pixel_numbers(self, picture_width: int) -> Words:
        """(size,) number of each corner, as the sampler knows it."""
        return self.corners_of_lattice.astype(np.uint32)

    def corners(self) -> tuple[Floats32, Floats32]:
        """Where the rays go through the picture: x and y, (size,) float32 each [pixels], exact."""
        row, column = np.divmod(self.corners_of_lattice, self.columns)
        scale = np.float32(self.scale)
        return column.astype(np.float32) * scale, row.astype(np.float32) * scale


class CornerFilm:
    """A film that takes in the radiance at corners; ``linear`` and ``samples`` are written in the end.

    Parameters
    ----------
    width, height : of the picture [pixels]
    depth : how many times a pixel may be divided
    rays : through each corner

    Attributes
    ----------
    linear : (3, H, W) float32 linear radiance
    samples : (H, W) int32 rays, each in the one pixel that has its corner on its upper or left side, or inside
    lattice : how many corners there are in all
    shared : corners asked for that had had their rays
    """

    def __init__(self, width: int, height: int, depth: int, rays: int) -> None:
        self.width, self.height, self._depth, self._rays = width, height, depth, rays
        self.linear: Floats32 = np.zeros((3, height, width), np.float32)
        self.samples: Numbers = np.zeros((height, width), np.int32)
        self.shared = self._shared = 0
        self._columns = (width << depth) + 1
        self.lattice = self._columns * ((height << depth) + 1)
        self._groups = 0
        self._known: Numbers64 = np.empty(0, np.int64)
        self._radiance = np.empty((3, 0), np.float32)
        self._coming = self._known
        self._arrived = self._radiance

    @property
    def size(self) -> int:
        """Number of corners whose rays have been traced."""
        return len(self._known)

    def numbers(self, x: Floats32, y: Floats32) -> Numbers64:
        """Numbers of corners at (x, y) [pixels], which are points of the lattice; of x's shape, int64."""
        steps = np.float32(1 << self._depth)
        return (y * steps).astype(np.int64) * self._columns + (x * steps).astype(np.int64)

    def begin_round(self, numbers: Numbers64) -> list[Work]:
        """The work for those of some corners that have had no rays yet, each once."""
        self._coming = np.setdiff1d(numbers, self._known)
        self._shared = numbers.size - len(self._coming)
        self._arrived = np.zeros((3, len(self._coming)), np.float32)
        work: list[Work] = []
        start = 0
        scale = 1.0 / (1 << self._depth)
        count = -(-len(self._coming) * self._rays // RAYS)
        # Equal groups rather than full ones and a rest.
        for part in np.array_split(self._coming, count) if count else []:
            group = CornerGroup(self._groups, start, part, self._columns, scale)
            work.append(Work(group, 0, 0, self._rays, True))
            start += len(part)
            self._groups += 1
        return work

    def add(
        self,
        tile: CornerGroup,
        mean: Floats32,
        weight: Floats32 | float,
        samples: int,
        summed: bool,
    ) -> None:
        """Take in the radiance (3, n) of a group's corners."""
        self._arrived[:, tile.start : tile.start + tile.size] = mean

    def end_round(self) -> None:
        """Keep what has come, so that it is found."""
        self.shared += self._shared
        places = np.searchsorted(self._known, self._coming)
        self._known = np.insert(self._known, places, self._coming)
        self._radiance = np.insert(self._radiance, places, self._arrived, axis=1)

    def radiance(self, numbers: Numbers64) -> Floats32:
        """(3, ...) radiance at corners of any shape; all of them have had their rays."""
        places = np.searchsorted(self._known, numbers.ravel())
        return self._radiance.take(places, axis=1).reshape(3, *numbers.shape)

    def count_rays(self) -> None:
        """Write ``samples``."""
        row, column = np.divmod(self._known, self._columns)
        y = np.minimum(row >> self._depth, self.height - 1)
        x = np.minimum(column >> self._depth, self.width - 1)
        counts = np.bincount(y * self.width + x, minlength=self.samples.size)
        self.samples[:] = self._rays * counts.reshape(self.samples.shape)
