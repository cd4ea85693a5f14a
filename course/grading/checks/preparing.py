"""What checks compare with: arrays that the reference solution makes, from numbers of each check's own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from zlib import crc32

import numpy as np

from course.grading.checks.check import Array, Caller, Check

References = Callable[[str, Check], Mapping[str, Array]]
"""(module, check) -> the arrays that the check's ``prepare`` made."""


def generator(seed: int, module: str, check: Check) -> np.random.Generator:
    """The numbers of one check: its own, whatever other checks there are, and the same in every process."""
    name = f"{module}.{check.function}/{check.name}"
    return np.random.default_rng((seed, crc32(name.encode())))


KEPT = 32
"""Checks of which a maker of references keeps the arrays; a module has fewer that need any."""


def prepared(reference: Caller, seed: int) -> References:
    """References made on the spot with the reference solution's module, once for each check; they are read-only."""

    @lru_cache(maxsize=KEPT)
    def make(module: str, check: Check) -> Mapping[str, Array]:
        assert check.prepare is not None
        arrays = check.prepare(reference, generator(seed, module, check))
        for array in arrays.values():
            array.setflags(write=False)
        return arrays

    return lambda module, check: {} if check.prepare is None else make(module, check)
