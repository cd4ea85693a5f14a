"""A picture divided into blocks of 4 x 4 cells of pixels: large blocks, and small ones that are the cells of these."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats64, Indices

CELLS = 4
"""Cells along the side of a block."""

SMALLEST = 16
"""Pixels along the side of a block at least: cells of 4 x 4, wider than what reconstruction filters spread."""

MOST = 1024
"""Blocks at most, or nearly: in larger pictures they are larger. Among too many none can stand out."""


@dataclass(frozen=True)
class Blocks:
    """The borders of cells, CELLS x CELLS of which make a block: rows and columns of pixels, from 0 to the size."""

    rows: Indices
    columns: Indices

    @property
    def grid(self) -> tuple[int, int]:
        """Rows and columns of blocks."""
        return len(self.rows) // CELLS, len(self.columns) // CELLS

    def sums(self, values: Floats64) -> Floats64:
        """Sums (blocks, cells of a block, C) of values (H, W, C)."""
        by_rows = np.add.reduceat(values, self.rows[:-1], axis=0)
        sums = np.add.reduceat(by_rows, self.columns[:-1], axis=1)
        (down, across), channels = self.grid, sums.shape[2]
        sums = sums.reshape(down, CELLS, across, CELLS, channels).swapaxes(1, 2)
        return sums.reshape(down * across, CELLS * CELLS, channels)

    def place(self, number: int) -> tuple[int, int, int, int]:
        """Column and row of a block's upper left pixel, its width and height."""
        y, x = divmod(number, self.grid[1])
        top, bottom = (int(self.rows[CELLS * (y + k)]) for k in (0, 1))
        left, right = (int(self.columns[CELLS * (x + k)]) for k in (0, 1))
        return left, top, right - left, bottom - top


def divide(height: int, width: int) -> tuple[Blocks, Blocks]:
    """Large blocks and small ones, which are the large ones' cells; as equal as may be, with no pixel left over."""
    side = max(SMALLEST, math.ceil(math.sqrt(height * width / MOST)))
    large, small = (
        [
            np.linspace(0, size, cells * (size // side or 1) + 1).astype(np.intp)
            for size in (height, width)
        ]
        for cells in (CELLS, CELLS * CELLS)
    )
    return Blocks(*large), Blocks(*small)
