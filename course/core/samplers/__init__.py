"""Samplers: the numbers in [0, 1) that paths use.

A block holds the same range of samples of several pixels. Path p of a block belongs to pixel p // samples, and is the
pixel's sample first + p % samples. So an array (paths,), reshaped to (pixels, samples), has a row per pixel.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from course.core.types import Floats32, Indices, Words

if TYPE_CHECKING:
    from numpy.random import Generator


@dataclass(frozen=True)
class Block:
    """The paths of some samples of some pixels, such as one pass of a tile.

    Attributes
    ----------
    pixels : (n,) uint32, number of each pixel in the picture, row by row
    first : number of the first sample of each pixel
    samples : number of samples of each pixel
    part : number of the tile, a part of the generators' seeds
    """

    pixels: Words
    first: int
    samples: int
    part: int

    @cached_property
    def size(self) -> int:
        """Number of paths: pixels times samples."""
        return len(self.pixels) * self.samples


class Sampler(ABC):
    """Draws numbers for the paths of a block; blocks may come in any order.

    ``name`` is that in scene files; ``extensible`` is true if n samples can be continued to 2n.
    """

    name: str
    extensible: bool

    @abstractmethod
    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """Numbers in [0, 1) for ``width`` dimensions from ``dimension`` on, (width, block.size) float32."""

    def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Floats32:
        """The columns of ``draw`` for paths (m,)."""
        return self.draw(block, dimension, width).take(path, axis=1)


def generator(seed: int, dimension: int, block: Block) -> Generator:
    """A new NumPy generator for one dimension of one block."""
    # numpy.random takes 20 ms to import; scenes without random numbers save them.
    from numpy.random import PCG64, Generator, SeedSequence

    return Generator(PCG64(SeedSequence((seed, dimension, block.part, block.first))))
