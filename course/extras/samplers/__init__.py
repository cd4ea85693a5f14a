"""Samplers: where the numbers of a path come from.

A sampler has a ``name``, says whether its points may be extended from n to 2n samples (``extensible``), and draws
``(width, paths)`` float32 numbers in [0, 1) for consecutive dimensions of a block of paths.
"""

from collections.abc import Callable
from typing import Any

from course.core.samplers import (
    Block,
    JitteredSampler,
    RandomSampler,
    RegularSampler,
    Sampler,
)
from course.core.types import Functions
from course.extras.samplers.low_discrepancy import ChainedSampler, HaltonSampler, HammersleySampler
from course.extras.samplers.sobol import SobolSampler
from course.extras.samplers.xorshift import XorshiftSampler

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


def make_sampler(name: str, seed: int, *functions: Callable[..., Any]) -> Sampler:
    """The sampler of that name.

    Parameters
    ----------
    functions : those that FUNCTIONS has for it, in that order
    """
    if not functions:
        return SobolSampler(seed)
    kinds: dict[str, Callable[[int, Functions], Sampler]] = {
        "random": RandomSampler,
        "jittered": JitteredSampler,
        "regular": RegularSampler,
        "halton": HaltonSampler,
        "hammersley": HammersleySampler,
        "chained": ChainedSampler,
        "xorshift": XorshiftSampler,
    }
    names = (function for _, function in FUNCTIONS[name])
    return kinds[name](seed, Functions(**dict(zip(names, functions, strict=True))))
