"""Samplers: where the numbers of a path come from.

A sampler has a ``name``, says whether its points may be extended from n to 2n samples (``extensible``), and draws
``(width, paths)`` float32 numbers in [0, 1) for consecutive dimensions of a block of paths.
"""

from __future__ import annotations

from typing import Protocol

from course.core.samplers.block import Block
from course.core.samplers.sobol import SobolSampler
from course.core.samplers.stratified import (
    JitteredSampler,
    RandomSampler,
    RegularSampler,
    Supersampling,
)
from course.core.types import Floats32

__all__ = ["Block", "Sampler", "make_sampler"]


class Sampler(Protocol):
    """What the renderer needs of a sampler."""

    name: str
    extensible: bool

    def draw(self, block: Block, dimension: int, width: int) -> Floats32: ...


def make_sampler(name: str, seed: int, functions: Supersampling | None) -> Sampler:
    """The sampler of that name; all but ``sobol`` place their points with the supersampling module."""
    if name == "sobol":
        return SobolSampler(seed)
    if functions is None:
        raise ValueError(f"the {name} sampler needs the supersampling module")
    kinds = {"random": RandomSampler, "jittered": JitteredSampler, "regular": RegularSampler}
    return kinds[name](seed, functions)
