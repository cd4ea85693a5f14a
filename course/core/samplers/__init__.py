"""Samplers: where the numbers of a path come from.

A sampler has a ``name``, says whether its points may be extended from n to 2n samples (``extensible``), and draws
``(width, paths)`` float32 numbers in [0, 1) for consecutive dimensions of a block of paths.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from course.core.samplers.block import Block
from course.core.samplers.low_discrepancy import ChainedSampler, HaltonSampler, HammersleySampler
from course.core.samplers.sobol import SobolSampler
from course.core.samplers.stratified import (
    JitteredSampler,
    RandomSampler,
    RegularSampler,
)
from course.core.samplers.xorshift import XorshiftSampler
from course.core.types import Floats32

__all__ = ["FUNCTIONS", "Block", "Sampler", "make_sampler"]

FUNCTIONS: dict[str, tuple[tuple[str, str], ...]] = {
    "sobol": (),
    "random": (("supersampling", "random"),),
    "jittered": (("supersampling", "jittered"),),
    "regular": (("supersampling", "regular"),),
    "halton": (("quasi_monte_carlo", "halton"),),
    "hammersley": (("quasi_monte_carlo", "hammersley"),),
    "chained": (("quasi_monte_carlo", "hammersley"), ("quasi_monte_carlo", "chain")),
    "xorshift": (("sampling", "xorshift32"),),
}
"""Every sampler, and the module and name of each function that its numbers come from."""


class Sampler(Protocol):
    """What the renderer needs of a sampler."""

    name: str
    extensible: bool

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """(width, block.size) float32 numbers in [0, 1) for consecutive dimensions."""
        ...


def make_sampler(
    name: str, seed: int, place: Callable[..., Any] | None = None, *further: Callable[..., Any]
) -> Sampler:
    """The sampler of that name.

    Parameters
    ----------
    place, further : the functions that FUNCTIONS has for it, in that order; None for ``sobol``, which needs none
    """
    if place is None:
        return SobolSampler(seed)
    kinds: dict[str, Callable[..., Sampler]] = {
        "random": RandomSampler,
        "jittered": JitteredSampler,
        "regular": RegularSampler,
        "halton": HaltonSampler,
        "hammersley": HammersleySampler,
        "chained": ChainedSampler,
        "xorshift": XorshiftSampler,
    }
    return kinds[name](seed, place, *further)
