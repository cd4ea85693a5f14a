"""What the checks of a function vary, seen from inside the function: signs, sizes, directions, dtypes, layouts, calls.

What no check varies, no check can find wrong. The arguments of all calls that the checks make are looked at, whatever
the checks meant by them.
"""

import pickle
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Array, Caller, Trial
from course.school.grading.checks.declare import declared_function
from course.school.grading.references import reference

UNIT, WIDE = 2.1, 50.0
"""What is larger than a unit vector's numbers is to be tried at sizes so many times apart."""


@dataclass
class Seen:
    """What one argument has been.

    Attributes
    ----------
    signs : -1, 0 and 1
    least, most : smallest and largest size of a number that isn't 0, of ordinary calls' largest numbers
    octants : of directions and points, in which of eight they have been
    dtypes, layouts : of arrays
    columns : numbers of columns
    """

    signs: set[int] = field(default_factory=set)
    least: float = np.inf
    most: float = 0.0
    octants: set[int] = field(default_factory=set)
    dtypes: set[str] = field(default_factory=set)
    layouts: set[str] = field(default_factory=set)
    columns: set[int] = field(default_factory=set)

    def add(self, value: Any, axis: int | None) -> None:
        """Look at one more."""
        if isinstance(value, tuple | list):
            for part in value:
                self.add(part, axis)
            return
        array = np.asarray(value)
        if array.dtype.kind not in "fiu":
            return
        if isinstance(value, np.ndarray):
            self.dtypes.add(str(value.dtype))
            self.layouts |= _layouts(value)
            if axis is not None and axis < value.ndim:
                self.columns.add(value.shape[axis])
        finite = array[np.isfinite(array)].astype(np.float64)
        if finite.size:
            self.signs |= {int(sign) for sign in np.unique(np.sign(finite))}
            largest = float(np.abs(finite).max())
            if largest > 0:
                self.least, self.most = min(self.least, largest), max(self.most, largest)
        if array.ndim and array.shape[0] == 3 and array.size:
            rows = array.reshape(3, -1) >= 0
            self.octants |= set(np.unique(rows[0] * 4 + rows[1] * 2 + rows[2]).tolist())

    @property
    def row(self) -> tuple[str, ...]:
        """All of it, to be read."""
        signs = "".join({-1: "-", 0: "0", 1: "+"}[sign] for sign in sorted(self.signs))
        sizes = f"{self.least:.1e} to {self.most:.1e}" if self.most else "0"
        some = (sorted(kinds) for kinds in (self.dtypes, self.layouts))
        columns = ", ".join(map(str, sorted(self.columns)[:8]))
        return (signs, sizes, str(len(self.octants) or ""), *map(", ".join, some), columns)

    @property
    def range(self) -> float:
        """The largest over the smallest size."""
        return self.most / self.least if self.most else 1.0


@dataclass
class FunctionSeen:
    """What one function has been called with: by argument, and whether anything was asked twice."""

    arguments: dict[str, Seen] = field(default_factory=lambda: defaultdict(Seen))
    repeated: bool = False


def varied(module: str, seeds: int = 3) -> dict[str, FunctionSeen]:
    """By function, what the checks of a module that render nothing call the reference with."""
    *_, seen = varying(module, seeds)
    return seen


def varying(module: str, seeds: int = 3) -> Iterator[dict[str, FunctionSeen]]:
    """The same after each seed, which adds to what the seeds before it have shown."""
    spy = _Spy(module, reference(module))
    for seed in range(seeds):
        for check in module_checks(module).checks:
            if check.kind not in ("picture", "bias", "speed"):
                check.run(Trial(check.function, spy, np.random.default_rng(seed)))
        yield spy.seen


def gaps(module: str, seen: dict[str, FunctionSeen]) -> Iterator[str]:
    """What is never varied, a line each: "thin_lens.lens_rays origin: only one sign"."""
    for name, function in seen.items():
        declared = declared_function(module, name)
        if not function.repeated:
            yield f"{module}.{name}: no call is made twice"
        for argument in declared.arguments:
            found, place = function.arguments[argument.name], f"{module}.{name} {argument.name}"
            if not found.dtypes:
                continue
            if found.most > UNIT and found.range < WIDE:
                yield f"{place}: sizes from {found.least:.2g} to {found.most:.2g} only"
            if argument.sizes[:1] == ("3",) and len(found.octants) < 8:
                yield f"{place}: in {len(found.octants)} of 8 octants"
            floating = not any("int" in dtype for dtype in found.dtypes)
            if floating and not {"float32", "float64"} <= found.dtypes:
                yield f"{place}: only {', '.join(sorted(found.dtypes))}"
            missing = {"rows", "read-only"} | (
                {"columns", "neither"} if argument.axis is not None else set()
            )
            if len(argument.sizes) > 1 and not missing <= found.layouts:
                yield f"{place}: no layout {', '.join(sorted(missing - found.layouts))}"
            if argument.axis is not None and not (
                {0, 1} <= found.columns and max(found.columns) > 1
            ):
                yield f"{place}: only {sorted(found.columns)} columns"


class _Spy:
    """A caller that looks at what it is asked."""

    def __init__(self, module: str, caller: Caller) -> None:
        self._module, self._caller = module, caller
        self._asked: set[tuple[str, bytes]] = set()
        self.seen: dict[str, FunctionSeen] = defaultdict(FunctionSeen)

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """Ask the other."""
        self._look(function, arguments)
        return self._caller.call(function, *arguments, **named)

    def call_and_look(self, function: str, *arguments: Any) -> tuple[Any, list[Any], bool]:
        """Ask the other."""
        self._look(function, arguments)
        return self._caller.call_and_look(function, *arguments)

    def _look(self, function: str, arguments: tuple[Any, ...]) -> None:
        seen = self.seen[function]
        if not seen.repeated:
            plain = [np.array(a, order="C") if isinstance(a, np.ndarray) else a for a in arguments]
            key = (function, pickle.dumps(plain))
            seen.repeated = key in self._asked
            self._asked.add(key)
        declared = declared_function(self._module, function)
        for argument, value in zip(declared.arguments, arguments, strict=False):
            seen.arguments[argument.name].add(value, argument.axis)


def _layouts(array: Array) -> set[str]:
    found = {"read-only"} if not array.flags.writeable else set()
    if array.flags.c_contiguous:
        return found | {"rows"}
    return found | {"columns" if array.flags.f_contiguous else "neither"}
