"""Samplers: where the numbers of a path come from.

A sampler has a ``name``, says whether its points may be extended from n to 2n samples (``extensible``), and draws
``(width, paths)`` float32 numbers in [0, 1) for consecutive dimensions of a block of paths.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from course.core.samplers.block import Block
from course.core.samplers.sobol import SobolSampler
from course.core.samplers.stratified import (
    JitteredSampler,
    RandomSampler,
    RegularSampler,
)
from course.core.types import Floats32

__all__ = ["Block", "Sampler", "make_sampler"]


class Sampler(Protocol):
    """What the renderer needs of a sampler."""

    name: str
    extensible: bool

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """(width, block.size) float32 numbers in [0, 1) for consecutive dimensions."""
        ...


def make_sampler(name: str, seed: int, place: Callable[..., Floats32] | None) -> Sampler:
    """The sampler of that name.

    Parameters
    ----------
    place : the function of the supersampling module that has the sampler's name; ``sobol`` needs none
    """
    if place is None:
        return SobolSampler(seed)
    if name == "random":
        return RandomSampler(seed, place)
    if name == "jittered":
        return JitteredSampler(seed, place)
    return RegularSampler(seed, place)
