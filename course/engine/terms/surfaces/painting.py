"""Colours that differ from place to place on a triangle: what a texture says at each hit.

A shape is painted in coordinates of its own: each corner of its triangles carries up to three numbers, such as the
corner's place on the ball before it was moved, and a function makes colours of the corners and the barycentrics.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats32, Floats64, Indices, Numbers
from course.engine.core.vectors import gather

ColorAt = Callable[[Floats32, Floats32], Floats32]
"""(barycentrics (3, n) of the corners 0, 1 and 2, what the corners carry (3 corners, 3, n)) -> (3, n)."""

NOT_PAINTED = -1


@dataclass(frozen=True)
class Paint:
    """A texture on its way to a surface.

    Attributes
    ----------
    corners : (T, 3, 3) float64, what the three corners of each triangle carry
    color_at : what it makes of them
    """

    corners: Floats64
    color_at: ColorAt


@dataclass(frozen=True)
class Painting:
    """The textures of a surface.

    Attributes
    ----------
    row : (T,) int32, for each triangle of the surface its row below; NOT_PAINTED for those without a texture
    corners : (R, 9) float32, what the three corners carry
    number : (R,) uint16, which of the functions
    color_at : the functions
    """

    row: Numbers
    corners: Floats32
    number: NDArray[np.uint16]
    color_at: tuple[ColorAt, ...]

    def tint(
        self,
        triangle: Numbers,
        u: Floats32,
        v: Floats32,
        seen: Callable[[Indices], tuple[Floats32, Floats32]] | None = None,
    ) -> Floats32 | None:
        """Colours (3, n) at hits, 1 where the surface has no texture; None where none of them has one.

        Parameters
        ----------
        triangle : (n,) of the surface
        u, v : (n,) barycentrics of the corners 1 and 2
        seen : how large a pixel is at some hits (m,), and the edges (6, m) of their triangles; None if nobody asks
        """
        tint = None
        for which, color_at, weights, corners in self.painted(triangle, u, v):
            if tint is None:
                tint = np.ones((3, len(triangle)), np.float32)
            at_size = None if seen is None else getattr(color_at, "at_size", None)
            if at_size is None or seen is None:
                tint[:, which] = color_at(weights, corners)
            else:
                tint[:, which] = at_size(weights, corners, *seen(which))
        return tint

    @property
    def sized(self) -> bool:
        """True if a colour depends on how large a pixel is."""
        return any(hasattr(color_at, "at_size") for color_at in self.color_at)

    def painted(
        self, triangle: Numbers, u: Floats32, v: Floats32
    ) -> Iterator[tuple[Indices, ColorAt, Floats32, Floats32]]:
        """Hits (m,) of one function after the other, with the function, their barycentrics and what corners carry."""
        row = self.row.take(triangle)
        painted = np.flatnonzero(row != NOT_PAINTED)
        if len(painted) == 0:
            return
        number = self.number.take(row.take(painted))
        for k, color_at in enumerate(self.color_at):
            which: Indices = painted[number == k]
            if len(which) == 0:
                continue
            corners = gather(self.corners, row.take(which)).reshape(3, 3, -1)
            p, q = u.take(which), v.take(which)
            yield which, color_at, np.stack((1 - p - q, p, q)), corners


def make_painting(parts: Sequence[tuple[int, Paint | None]]) -> Painting | None:
    """Join the paint of all parts of a surface; None where there is none.

    ``parts``: of each part, in their order in the surface, how many triangles it has and its paint, whose corners are
    those of just these triangles
    """
    paints = [paint for _, paint in parts if paint is not None]
    if not paints:
        return None
    sizes = [len(paint.corners) for paint in paints]
    rows = np.arange(sum(sizes), dtype=np.int32)
    row, first = [], 0
    for count, paint in parts:
        if paint is None:
            row.append(np.full(count, NOT_PAINTED, np.int32))
        else:
            row.append(rows[first : first + count])
            first += count
    return Painting(
        np.concatenate(row),
        _in_float32(np.concatenate([paint.corners.reshape(-1, 9) for paint in paints])),
        np.repeat(np.arange(len(paints), dtype=np.uint16), sizes),
        tuple(paint.color_at for paint in paints),
    )


def _in_float32(corners: Floats64) -> Floats32:
    """The same places; from 1e30 on, where neighbouring numbers lie a whole texture apart, the outermost."""
    return np.clip(corners, -1e30, 1e30).astype(np.float32)
