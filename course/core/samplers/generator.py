"""Random generators that don't depend on which thread or in which order a block is rendered."""

from __future__ import annotations

from typing import TYPE_CHECKING

from course.core.samplers.block import Block

if TYPE_CHECKING:
    from numpy.random import Generator


def generator(seed: int, dimension: int, block: Block) -> Generator:
    """A fresh NumPy generator for one dimension of one block of paths."""
    # numpy.random takes 20 ms to import, which a scene without random numbers shall not pay.
    from numpy.random import PCG64, Generator, SeedSequence

    return Generator(PCG64(SeedSequence((seed, dimension, block.part, block.first))))
