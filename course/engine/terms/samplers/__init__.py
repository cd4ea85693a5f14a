"""Samplers: where the numbers of a path come from.

A sampler has a ``name``, says whether its points may be extended from n to 2n samples (``extensible``), and draws
``(width, paths)`` float32 numbers in [0, 1) for consecutive dimensions of a block of paths.
"""

from collections.abc import Callable
from typing import Any

from course.engine.core.samplers import (
    Block,
    JitteredSampler,
    RandomSampler,
    RegularSampler,
    Sampler,
)
from course.engine.core.types import Functions
from course.engine.terms.samplers.halton import (
    ChainedSampler,
    HaltonSampler,
    HammersleySampler,
)
from course.engine.terms.samplers.sobol import SobolSampler
from course.engine.terms.samplers.xorshift import XorshiftSampler

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
    "blue_noise": (("blue_noise", "shuffled_z_order"),),
    "dithered": (("blue_noise", "void_and_cluster"), ("blue_noise", "dithered_points")),
}
"""Every sampler, and the module and name of each function that its numbers come from."""


def make_sampler(
    name: str, seed: int, *functions: Callable[..., Any], size: tuple[int, int] = (1, 1)
) -> Sampler:
    """The sampler of that name.

    Parameters
    ----------
    functions : those that FUNCTIONS has for it, in that order
    size : width and height of the picture, for samplers whose pixels know their neighbours
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
    own = Functions(**dict(zip(names, functions, strict=True)))
    if FUNCTIONS[name][0][0] == "blue_noise":
        from course.engine.terms.samplers import blue_noise

        return blue_noise.SAMPLERS[name](seed, own, size)
    return kinds[name](seed, own)
