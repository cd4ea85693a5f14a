"""Contracts as they are read: for the renderer, and for the checks. ``signatures`` beside it has them as text."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache, cached_property
from math import prod
from typing import Any

import numpy as np

from course.engine.functions.signatures import CONTRACTS

DTYPES: dict[str, Any] = {"whole": "int", "floating": "floating", "bool": np.bool_}
DTYPES |= {name: getattr(np, name) for name in ("float32", "float64", "int32", "uint32")}
"""Numbers of a result: a dtype, or a kind of which any dtype will do."""

_KINDS = {np.bool_: "bool", "int": "whole", np.int32: "whole", np.uint32: "whole"}

Size = int | str | tuple[tuple[str, ...], int]
"""A number, a word, or words whose sizes are multiplied and then divided by a number."""


@dataclass(frozen=True)
class ResultContract:
    """One result.

    Attributes
    ----------
    name, shape : as the contract has them
    dtype : None for that of the batch arguments; a kind ("int", "floating") where any of it does
    endless : "infinite" where infinity is legal, "unbounded" where both infinities are; "" where it is finite
    unit : whether it is directions of length 1
    below : of whole numbers the size or number that they are below, from 0 on; "" where any will do
    """

    name: str
    shape: str
    dtype: Any = None
    endless: str = ""
    unit: bool = False
    below: str = ""

    @cached_property
    def kind(self) -> str:
        """Condition for results: "" (floating and finite), "unit", "infinite", "unbounded", "whole" or "bool"."""
        return "unit" if self.unit else _KINDS.get(self.dtype, self.endless)

    @cached_property
    def sizes(self) -> tuple[Size, ...]:
        """Of each axis."""
        return tuple(map(_size, self.shape.split()))

    def sized(self, known: dict[str, int]) -> tuple[int | str, ...]:
        """Its shape in a call; sizes that nobody knows stay words."""
        return tuple([_known(size, known) for size in self.sizes])


@dataclass(frozen=True)
class Contract:
    """Names and shapes of the arguments, and the results.

    Attributes
    ----------
    arguments : names and shapes; numbers have none
    several : whether the one result is a list of arrays, as many as the argument's with a ``*``
    """

    arguments: tuple[tuple[str, str], ...]
    results: tuple[ResultContract, ...]
    several: bool

    def sizes(self, values: Iterable[Any]) -> dict[str, int]:
        """The sizes that the arguments of a call say, by their words."""
        known: dict[str, int] = {}
        for (name, shape), value in zip(self.arguments, values, strict=False):
            if shape == "*":
                known["*"] = len(value)
            elif isinstance(value, (int, np.integer, tuple)):
                known[name] = len(value[-1]) if isinstance(value, tuple) else int(value)
            elif shape:
                for word, size in zip(shape.split(), np.shape(value), strict=False):
                    # A single column stands for as many as there are.
                    if known.get(word, 1) == 1:
                        known[word] = size
        return known


def contract(function: str) -> Contract:
    """The contract of a function that the renderer calls, "module.function"."""
    return parsed(CONTRACTS[function])


@cache
def parsed(text: str) -> Contract:
    """A contract as it is written."""
    before, _, after = text.partition("->")
    pairs = [part.partition(":") for part in before.split(",")]
    arguments = tuple((name.strip(), shape.strip()) for name, _, shape in pairs)
    results, several = [], "*" in after.split()
    for part in after.split(","):
        name, _, rest = part.partition(":")
        words = rest.split()
        below = next((word for word in words if word.startswith("below:")), "")
        said = {*DTYPES, "unit", "infinite", "unbounded", "*", below} & {*words}
        results.append(
            ResultContract(
                name.strip(),
                " ".join(word for word in words if word not in said),
                next((DTYPES[word] for word in words if word in DTYPES), None),
                next((word for word in words if word in ("infinite", "unbounded")), ""),
                "unit" in said,
                below[6:],
            )
        )
    return Contract(arguments, tuple(results), several)


def _size(word: str) -> Size:
    product, _, divisor = word.partition("/")
    if product.isdigit():
        return int(product)
    return (tuple(product.split("*")), int(divisor or 1)) if {"*", "/"} & set(word) else word


def _known(size: Size, known: dict[str, int]) -> int | str:
    if isinstance(size, tuple):
        return prod(known[word] for word in size[0]) // size[1]
    return known.get(size, size) if isinstance(size, str) else size
