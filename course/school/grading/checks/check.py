"""One check of one student function, and what it hands back.

A check is a plain function that takes a ``Trial`` and returns; it raises ``Failure`` where the student's function is
wrong. Whatever else it raises is the grader's own fault and never counts against a student.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from course.school.grading.looked import Looked

Array = NDArray[Any]
Kind = Literal["contract", "property", "distribution", "picture", "bias", "order", "speed", "whole"]
FigureKind = Literal["points", "histogram", "pictures", "rays"]
Role = Literal["core", "corner", "convention"]
"""Of a check: a function of no use fails what is "core"; one that is right elsewhere may fail a "corner"."""


@dataclass(frozen=True)
class Figure:
    """Something that a report can draw.

    Attributes
    ----------
    kind : "points" draws (2, N) numbers in the unit square or disk, "histogram" values beside their density,
        "pictures" two pictures and their difference, "rays" those of a pixel in their scene
    title : str
    arrays : what is drawn, by name: ``yours`` and, if there is one, ``expected``; pictures are (3, H, W) linear
        RGB, and rays ``data``, a view as JSON, deflated; a histogram may have ``u``, the numbers that the values
        were made from, one by one
    """

    kind: FigureKind
    title: str
    arrays: Mapping[str, Array]


class Failure(Exception):  # noqa: N818 - it is no error of the program
    """A student's function is wrong.

    Parameters
    ----------
    expected, found : what should have come, and what came; short, with numbers
    where : the worst ray or pixel, with the arguments that show it
    hint : what to look at; never the code
    slip : the name in ``mistakes.SLIPS`` of the mistake that the failure shows by itself, if it does
    """

    def __init__(
        self, expected: str, found: str, where: str = "", hint: str = "", slip: str = ""
    ) -> None:
        super().__init__(f"expected {expected}, found {found}" + (f" ({where})" if where else ""))
        self.slip = slip
        self.expected, self.found, self.where, self.hint = expected, found, where, hint
        self.example = ""
        """The smallest input that shows it, with what came and what must hold."""


class Caller(Protocol):
    """Whoever calls the functions of one module: a worker, or this process for trusted ones."""

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value: an ndarray, a number, or a tuple of these; ``StudentError`` if there is none."""
        ...

    def call_and_look(self, function: str, *arguments: Any) -> Looked:
        """The value, the arguments as they are after the call, and what else has changed since the last such call."""
        ...


@dataclass
class Trial:
    """One run of one check.

    Attributes
    ----------
    function : the function's name
    caller : of the student's module
    rng : numbers for this check; the same for the same seed, task and check
    references : arrays that ``Check.prepare`` made with the reference solution
    figures : what the check has shown so far
    notes : what the student should know though nothing is wrong
    reference_caller : the solution in a worker of its own, to compare times with; None where there is none
    """

    function: str
    caller: Caller
    rng: np.random.Generator
    references: Mapping[str, Array] = field(default_factory=dict)
    figures: list[Figure] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    reference_caller: Caller | None = None

    def call(self, *arguments: Any, **named: Any) -> Any:
        """Call the function that the check is about."""
        return self.caller.call(self.function, *arguments, **named)

    def generator(self) -> np.random.Generator:
        """Numbers for one call: the student may get a copy of them, so no two calls share a generator."""
        return np.random.default_rng(int(self.rng.integers(2**62)))

    def show(self, kind: FigureKind, title: str, **arrays: Array) -> None:
        """Keep something for the report to draw; it is drawn if the check fails."""
        self.figures.append(Figure(kind, title, arrays))


Prepare = Callable[[Caller, np.random.Generator], dict[str, Array]]
"""(the reference solution's module, rng) -> arrays; rng is the very one that ``run`` will get in ``Trial.rng``."""


@dataclass(frozen=True)
class Check:
    """One check.

    Attributes
    ----------
    function : what it checks
    name : short, unique among the function's checks: "uniform"
    title : what is right if it passes: "Points are uniform over the disk's area"
    run : raises ``Failure``
    kind : which sort of check it is
    points : its weight
    false_fail : probability that a right function fails by chance; 0 for checks without chance
    prepare : makes the arrays that a student's copy can't; None if the check needs none
    role : what it is worth
    smallest : the smallest call that gives no usable value, as text; empty if small ones do
    numbers : name of the check whose random numbers it gets; its own if empty
    any_seed : whether what ``prepare`` makes is the same for all seeds
    """

    function: str
    name: str
    title: str
    run: Callable[[Trial], None]
    kind: Kind = "property"
    points: float = 1.0
    false_fail: float = 0.0
    prepare: Prepare | None = None
    role: Role = "core"
    smallest: Callable[[Trial], str] = lambda _: ""
    numbers: str = ""
    any_seed: bool = False


@dataclass(frozen=True)
class ModuleChecks:
    """Everything that is checked in one module.

    Attributes
    ----------
    module : its name
    checks : in the order in which they run
    prints : by function, a check whose arrays tell which known mistake somebody makes
    rays : by function, what shows the rays behind its wrong picture; it gets the picture check's arrays and its own
    named : by function, (caller, those arrays) -> the mistake's name and what the student is told; None for none
    """

    module: str
    checks: tuple[Check, ...]
    prints: Mapping[str, Check] = field(default_factory=dict)
    rays: Mapping[str, Check] = field(default_factory=dict)
    named: Mapping[str, Callable[[Caller, Mapping[str, Array]], tuple[str, str] | None]] = field(
        default_factory=dict
    )


References = Callable[[str, Check], Mapping[str, Array]]
"""(module, check) -> the arrays that the check's ``prepare`` made."""


def generator(seed: int, module: str, check: Check) -> np.random.Generator:
    """The numbers of one check: its own, whatever other checks there are, and the same in every process."""
    name = f"{module}.{check.function}/{check.numbers or check.name}"
    return np.random.default_rng((seed, crc32(name.encode())))
