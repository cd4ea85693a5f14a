"""Square cells of a picture, through each of which one ray is sent ahead."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats64, Indices

BESIDE = 1 / 64
"""A pixel may see of a thing so much of what the pixels next to it see: images are known to a tenth of one."""

_ALL, _LOW, _HIGH = slice(None), slice(None, -1), slice(1, None)
NEXT = ((_ALL, _LOW, _ALL), (_ALL, _HIGH, _ALL)), ((_ALL, _ALL, _LOW), (_ALL, _ALL, _HIGH))
"""Cells of a grid and those that are next to them, along both axes."""


@dataclass(frozen=True)
class CellGrid:
    """Square cells of the picture, in blocks of rows and columns.

    Attributes
    ----------
    corners : (2, *shape), row and column of each cell's upper left corner [pixels]
    side : of a cell [pixels]
    """

    corners: Floats64
    side: float
    shape: tuple[int, int, int]

    @property
    def size(self) -> int:
        """Number of cells."""
        return int(np.prod(self.shape))

    @property
    def coarse(self) -> bool:
        """Whether cells are larger than pixels."""
        return self.side > 1

    def add(self, picture: Floats64, cells: Indices, values: Floats64) -> None:
        """Add values (n,) of some cells to the pixels (H, W) that they are or that they lie in."""
        rows, columns = np.floor(self.corners.reshape(2, -1)[:, cells]).astype(np.intp)
        share = min(self.side, 1) ** 2
        for down in range(max(int(self.side), 1)):
            for right in range(max(int(self.side), 1)):
                y, x = rows + down, columns + right
                inside = (y < picture.shape[0]) & (x < picture.shape[1])
                np.add.at(picture, (y[inside], x[inside]), share * values[inside])

    def changes(self, field: Floats64, key: Indices) -> Floats64:
        """The larger of a field's squared changes from cell to cell, along either axis.

        Parameters
        ----------
        field, key : (3, n), and (n,) which differs where neighbours have nothing in common

        Returns
        -------
        (n,), -1 where no next cell has the same key
        """
        fields, keys = field.reshape(3, *self.shape), key.reshape(self.shape)
        result = np.full(self.shape, -1.0)
        for first, second in NEXT:
            step = ((fields[:, *first] - fields[:, *second]) ** 2).sum(axis=0)
            step[keys[first] != keys[second]] = np.inf
            # Of the two neighbours along an axis the nearer one: beyond the other may lie another face.
            near = np.full(self.shape, np.inf)
            for part in (first, second):
                near[part] = np.minimum(near[part], step)
            result = np.maximum(result, np.where(np.isinf(near), -1, near))
        return result.ravel()


def spread(values: Floats64) -> Floats64:
    """Values (H, W), none below a BESIDE of the largest next to it."""
    height, width = values.shape
    padded = np.pad(values, 1)
    largest = np.max([padded[y : y + height, x : x + width] for y in range(3) for x in range(3)], 0)
    result: Floats64 = np.maximum(values, BESIDE * largest)
    return result
