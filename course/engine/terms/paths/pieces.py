"""The paths of a block in pieces: about as many rays as a batch has, at every depth.

Few rays cost nearly as much as many, for each pass over them has its price. Most paths end soon, so the rest of a piece
soon is small; it waits until other pieces have come to the same depth, and goes on with them.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.rays import RAYS, Draws, Rays, join_rays
from course.engine.core.types import Floats32, Mask
from course.engine.terms.work import spread_pixels


@dataclass(frozen=True)
class Piece:
    """Paths of one depth that are followed together.

    Attributes
    ----------
    adds_lights : (n,) which rays bring light from lamps and the environment; None for none of them
    pixels : of the block, in whose paths theirs are numbered
    draws : of these pixels
    path_radiance : (3, paths of these pixels) float32
    """

    rays: Rays
    adds_lights: Mask | None
    pixels: slice
    draws: Draws
    path_radiance: Floats32


class Pieces:
    """The pieces of a block, and those that wait for others.

    ``draws``, ``path_radiance``: of the whole block
    """

    def __init__(self, draws: Draws, path_radiance: Floats32) -> None:
        self._draws = draws
        self._path_radiance = path_radiance
        self._waiting: dict[int, Piece] = {}

    def cut(self, rays: Rays, most: int) -> Iterator[Piece]:
        """The camera rays in batches of RAYS, or ``most`` equal ones if these are fewer."""
        block = self._draws.block
        pixels = len(block.pixels)
        count = min(-(-block.size // RAYS), most, pixels)
        each = pixels if count == 1 else spread_pixels(-(-pixels // count), block.samples, True)
        for first in range(0, pixels, each):
            mine = slice(first, min(first + each, pixels))
            some = rays if count == 1 else rays.part(self._paths(mine))
            yield self._piece(some, np.ones(some.size, np.bool_), mine)

    def joined(self, piece: Piece, depth: int, least: int) -> Piece | None:
        """The piece with others that have waited at its depth; None if fewer than ``least`` rays wait for more."""
        others = self._waiting.get(depth)
        if others is not None and others.rays.size + piece.rays.size <= RAYS:
            piece = self._together(self._waiting.pop(depth), piece)
        if depth in self._waiting or piece.rays.size >= least:
            return piece
        self._waiting[depth] = piece
        return None

    def shallowest(self) -> tuple[Piece, int] | None:
        """A piece that waits, with its depth: the others may be joined on its way."""
        if not self._waiting:
            return None
        depth = min(self._waiting)
        return self._waiting.pop(depth), depth

    def _together(self, *pieces: Piece) -> Piece:
        """Pieces of one depth as one."""
        ends = [(piece.pixels.start, piece.pixels.stop) for piece in pieces]
        pixels = slice(min(start for start, _ in ends), max(stop for _, stop in ends))
        numbered = []
        for piece in pieces:
            assert piece.rays.path is not None
            before = (piece.pixels.start - pixels.start) * self._draws.block.samples
            numbered.append(replace(piece.rays, path=piece.rays.path + before))
        adds_lights = None
        if any(piece.adds_lights is not None for piece in pieces):
            adds_lights = np.concatenate(
                [
                    np.zeros(piece.rays.size, np.bool_)
                    if piece.adds_lights is None
                    else piece.adds_lights
                    for piece in pieces
                ]
            )
        return self._piece(join_rays(numbered), adds_lights, pixels)

    def _piece(self, rays: Rays, adds_lights: Mask | None, pixels: slice) -> Piece:
        block = self._draws.block
        paths = self._paths(pixels)
        part = replace(block, pixels=block.pixels[pixels])
        costs = self._draws.costs
        draws = replace(self._draws, block=part, costs=None if costs is None else costs.part(paths))
        return Piece(rays, adds_lights, pixels, draws, self._path_radiance[:, paths])

    def _paths(self, pixels: slice) -> slice:
        """The paths of some pixels among those of the block."""
        samples = self._draws.block.samples
        return slice(pixels.start * samples, pixels.stop * samples)
