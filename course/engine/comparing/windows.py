"""Sums over square windows of a picture, of several sizes, and how likely noise alone makes such sums.

A field holds a number for each pixel, which noise alone makes positive as often as negative. Its sum over a window is
divided by the root of the sum of its squares:

    T = sum of f / root of the sum of f^2

Whatever the sizes of the numbers are, if only their signs are independent and even, then

    P(|T| >= t) <= 2 C (1 - Phi(t)),    C = 1 / (4 (1 - Phi(root of 2))) = 3.18

(Bentkus and Dzindzalieta, "A tight Gaussian bound for weighted sums of Rademacher random variables", 2015). So neither
the noise of a pixel nor its law need be known, and T of a window of n pixels is at most the root of n.
"""

from collections.abc import Collection, Iterator
from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Indices

CELL = 4
"""Pixels along the side of a cell, of which windows consist."""

SMALLEST = 2 * CELL
"""Pixels along the side of the smallest window; in smaller ones T can't be large enough."""

BOUND = 3.178


@dataclass(frozen=True)
class Window:
    """A rectangle of pixels: column and row of its upper left one, its width and height."""

    left: int
    top: int
    width: int
    height: int

    @property
    def pixels(self) -> tuple[slice, slice]:
        """Index of its rows and columns."""
        return slice(self.top, self.top + self.height), slice(self.left, self.left + self.width)

    @property
    def is_line(self) -> bool:
        """Whether it is a part of one row or column."""
        return min(self.width, self.height) == 1

    def meets(self, other: "Window") -> bool:
        """Whether they share pixels."""
        return (
            self.left < other.left + other.width
            and other.left < self.left + self.width
            and self.top < other.top + other.height
            and other.top < self.top + self.height
        )


@dataclass(frozen=True)
class Grid:
    """Borders of cells in rows and columns of pixels, from 0 to the picture's size; with no pixel left over."""

    rows: Indices
    columns: Indices

    @classmethod
    def over(cls, height: int, width: int) -> "Grid":
        """Cells as equal as may be."""
        rows, columns = (
            np.linspace(0, size, max(size // CELL, 1) + 1).astype(np.intp)
            for size in (height, width)
        )
        return cls(rows, columns)

    @property
    def side(self) -> int:
        """Pixels along the longest side of a cell."""
        return int(max(*np.diff(self.rows).tolist(), *np.diff(self.columns).tolist()))

    def strip(self, rows: slice) -> "Grid":
        """The cells of some rows of pixels."""
        kept = self.rows[(self.rows >= rows.start) & (self.rows <= rows.stop)]
        return Grid(kept - rows.start, self.columns)

    def cells(self, values: Floats64) -> Floats64:
        """Sums (cells down, across) of values (H, W)."""
        by_rows = np.add.reduceat(values, self.rows[:-1], axis=0)
        sums: Floats64 = np.add.reduceat(by_rows, self.columns[:-1], axis=1)
        return sums

    def sides(self) -> list[int]:
        """Cells along the side of a window: 2, 4, 8, ..., and at last the whole picture's larger side."""
        most = max(len(self.rows), len(self.columns)) - 1
        powers = [2**k for k in range(1, 32) if 2**k < most]
        return [*powers, most]

    def windows(self, side: int) -> "Windows":
        """Windows of a size, each half a window from the next."""
        return Windows(
            self, _starts(len(self.rows) - 1, side), _starts(len(self.columns) - 1, side)
        )


@dataclass(frozen=True)
class Windows:
    """Windows of one size: first and last cells, (2, down) and (2, across)."""

    grid: Grid
    down: Indices
    across: Indices

    @property
    def count(self) -> int:
        """Windows of this size."""
        return int(self.down.shape[1] * self.across.shape[1])

    def sums(self, cells: Floats64) -> Floats64:
        """Sums (..., down, across) over each window, of (..., cells down, across)."""
        total = np.zeros((*cells.shape[:-2], cells.shape[-2] + 1, cells.shape[-1] + 1))
        cells.cumsum(axis=-2).cumsum(axis=-1, out=total[..., 1:, 1:])
        rows = total[..., self.down[1], :] - total[..., self.down[0], :]
        sums: Floats64 = rows[..., self.across[1]] - rows[..., self.across[0]]
        return sums

    def place(self, number: int) -> Window:
        """The pixels of a window by its number, row by row."""
        y, x = divmod(number, self.across.shape[1])
        top, bottom = self.grid.rows[self.down[:, y]].tolist()
        left, right = self.grid.columns[self.across[:, x]].tolist()
        return Window(left, top, right - left, bottom - top)


def _starts(cells: int, side: int) -> Indices:
    """First cells of windows and the ones after their last (2, n), along one side of the picture."""
    side = min(side, cells)
    first = np.unique([*range(0, cells - side + 1, max(side // 2, 1)), cells - side])
    return np.stack((first, first + side)).astype(np.intp)


def p_value(t: float) -> float:
    """How often noise alone reaches T in a window, at most."""
    # Imported here: no other command needs SciPy's functions.
    from scipy.special import ndtr

    return min(1.0, 2 * BOUND * float(ndtr(-abs(t))))


@dataclass(frozen=True)
class Field:
    """Numbers of each pixel (H, W) that noise makes positive as often as negative.

    Attributes
    ----------
    values : the field
    squares : what noise makes of their squares where that is known to be more than they show; else 0
    off : by what the values may be off in one direction, for the pictures are rounded
    """

    values: Floats64
    squares: Floats64
    off: Floats64

    def cells(self, rows: slice, grid: Grid) -> Floats64:
        """Sums over cells of some rows (4, down, across): of the values, their squares, and the two others."""
        return np.stack([grid.cells(one[rows]) for one in self._parts])

    def lines(self, rows: slice, axis: int) -> Floats64:
        """The same sums along one axis of some rows, (4, n)."""
        return np.stack([one[rows].sum(axis=axis) for one in self._parts])

    @property
    def _parts(self) -> tuple[Floats64, ...]:
        return self.values, self.values**2, self.squares, self.off


INDEPENDENT = 1.5
"""Inflation up to which cells side by side count as independent; else there is a cell between them."""


def alike(cells: Floats64, inflation: float) -> Floats64:
    """Two more fields, (2, 4, down, across), of cells (fields, 4, down, across): products of neighbours.

    Of independent noise the product of two cells is as often positive as negative, and the products in a row are as
    independent as its cells. Where something differs whose sign turns within a window, they are positive. The first
    field has products across, the second down.
    """
    found = np.zeros((2, *cells.shape[1:]))
    apart = 1 if inflation <= INDEPENDENT else 2
    pairs = (
        (cells[..., :-apart], cells[..., apart:]),
        (cells[..., :-apart, :], cells[..., apart:, :]),
    )
    for field, (one, other) in zip(found, pairs, strict=True):
        values = (one[:, 0] * other[:, 0]).sum(axis=0)
        known = np.sqrt(one[:, 2] * other[:, 2]).sum(axis=0) ** 2
        off = np.abs(one[:, 0]) * other[:, 3] + (np.abs(other[:, 0]) + other[:, 3]) * one[:, 3]
        down, across = values.shape
        field[:, :down, :across] = np.stack((values, values**2, known, off.sum(axis=0)))
    return found


@dataclass(frozen=True)
class Sum:
    """The most significant window of one field and one size; its p-value is corrected for the number of windows."""

    field: int
    t: float
    p_value: float
    place: Window
    whole: bool


def largest_sums(
    cells: Floats64, grid: Grid, inflation: float, positive: Collection[int]
) -> Iterator[Sum]:
    """Of each field and each size of windows; of some fields only positive sums count.

    ``cells``: sums (fields, 4, down, across) as `Field.cells` returns them;
    ``inflation``: by what the variance of sums is larger, for neighbours are alike.
    """
    sides = grid.sides()
    squares = cells[:, 1].sum(axis=(1, 2))
    for side in sides:
        windows = grid.windows(side)
        t = t_of(windows.sums(cells), squares, inflation)
        t[list(positive)] *= t[list(positive)] > 0
        for field, of_windows in enumerate(t.reshape(len(t), -1)):
            number = int(np.abs(of_windows).argmax())
            largest = float(of_windows[number])
            p = min(1.0, windows.count * p_value(largest))
            yield Sum(field, largest, p, windows.place(number), side == sides[-1])


def t_of(sums: Floats64, squares: Floats64, inflation: float) -> Floats64:
    """T (fields, ...) with its sign, of sums (fields, 4, ...) as `Field.cells` returns them.

    ``squares``: (fields,) of all values of a picture
    """
    total, seen, known, off = np.moveaxis(sums, 1, 0)
    size = np.maximum(np.abs(total) - off, 0)
    variance = np.maximum(np.maximum(seen, known), 0)
    # Differences of cumulated sums leave some rounding where all is 0.
    least = 1e-14 * squares.reshape(-1, *(1,) * (total.ndim - 1))
    t = np.divide(
        size, np.sqrt(variance * inflation), out=np.zeros_like(size), where=variance > least
    )
    signed: Floats64 = np.copysign(t, total)
    return signed
