"""What a function of the course is declared to be: arguments, results, and the laws that hold between them.

A declaration is all that a module writes down. The checks of the conventions follow from it (``conventions.py``), the
laws are run on arguments that it makes (``laws.py``), failures are cut down to the smallest input that shows them
(``examples.py``), and a mistake is told by a known wrong submission that behaves alike (``mistakes.py``).

What arguments and results there are, and of which shape, says the function's contract
(``course/engine/functions/signatures.py``); a declaration adds how arguments are made, and the laws.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from functools import cache
from importlib import import_module
from math import gcd, prod
from typing import Any

import numpy as np

from course.engine.functions.contracts import ResultContract, parsed
from course.engine.functions.modules import COURSE
from course.engine.functions.signatures import CONTRACTS
from course.school.grading.checks.check import Array, Failure, Kind, Role, Trial
from course.school.grading.checks.drawing import Draw, worst_directions, worst_units

COLUMNS = "N"

DTYPES = (np.float32, np.float64)


class Arguments(dict[str, Any]):
    """Arguments by name, in their order; ``a.name`` reads one."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None


WHOLE = 40.0
"""Weight of a law that says all of a function's values: pictures, of weight 2, miss much that leaves it of no use."""

Case = Callable[[Draw], Mapping[str, Any]]
"""Legal arguments; those that it leaves out are made as they are declared."""


@dataclass(frozen=True)
class Made:
    """How values of an argument are made.

    Attributes
    ----------
    make : a legal value; None where cases give it, for it hangs on other arguments
    wrong : values that raise ``ValueError``, besides those of wrong shape
    corners : of a dtype, columns at the ends of what is legal
    batch : whether its dtype is the results'; if not given, where the argument has an axis of any size
    single : whether it may be one value for all columns as well: its shape without them, and no batch then
    """

    make: Callable[[Draw], Any] | None = None
    wrong: tuple[Any, ...] = ()
    corners: Callable[[Any], Array] | None = None
    batch: bool | None = None
    single: bool = False


@dataclass(frozen=True, kw_only=True)
class Argument(Made):
    """One argument; its name and shape are the contract's."""

    name: str
    sizes: tuple[str, ...]

    @property
    def axis(self) -> int | None:
        """Of the columns; None if it has none."""
        return self.sizes.index(COLUMNS) if COLUMNS in self.sizes else None

    def one(self, value: Any) -> Any:
        """The first column's value of a batch, for all columns."""
        first = np.asarray(value).take(0, self.axis).astype(np.float64)
        return first if first.ndim else float(first)


def directions() -> Made:
    """Unit vectors (3, N), anywhere and around the axes."""
    return Made(lambda d: d.directions(), corners=worst_directions)


def points(reach: float = 3.0) -> Made:
    """Points (3, N) within that reach of the origin along each axis [m]."""
    return Made(lambda d: d.lengths(-reach, reach, 3, d.n))


def values(low: float, high: float, wrong: tuple[Any, ...] = ()) -> Made:
    """A number in [low, high) for each column."""

    def make(draw: Draw) -> Array:
        # What is drawn after it stays as it was while other sizes were drawn here, too.
        draw.rng.integers(1, 7)
        return draw.uniform(low, high, draw.n)

    return Made(make, wrong)


def point(reach: float = 3.0) -> Made:
    """A single point (3,) [m]: an array of either dtype, which never counts."""
    return Made(lambda d: d.lengths(-reach, reach, 3))


def number(low: float, high: float, wrong: tuple[float, ...] = ()) -> Made:
    """A number from low to high, both over 0, spread over its powers of ten."""
    return Made(lambda d: d.number(low, high), wrong)


def length(low: float, high: float, wrong: tuple[float, ...] = ()) -> Made:
    """A number that is a length [m]: it grows with the scene."""
    return Made(lambda d: d.scale * d.number(low, high), wrong)


def count(low: int, high: int, wrong: tuple[Any, ...] = ()) -> Made:
    """A whole number from low to high."""
    return Made(lambda d: int(d.rng.integers(low, high + 1)), wrong)


def _usual(name: str, sizes: tuple[str, ...]) -> Made:
    """Where a declaration says nothing: numbers u in [0, 1), single points, a generator, or what cases give."""
    if name == "rng":
        return Made(lambda d: np.random.default_rng(int(d.rng.integers(2**62))))
    if sizes == ("3",):
        return point()
    if name != "u":
        return Made()
    if len(sizes) == 1:
        return Made(lambda d: d.units(1)[0], corners=lambda t: worst_units(1, t)[0])
    rows = int(sizes[0])
    return Made(lambda d: d.units(rows), corners=lambda t: worst_units(rows, t))


@dataclass(frozen=True)
class Law:
    """Something that holds for every right function.

    Attributes
    ----------
    name, title : as a check has them
    run : raises ``Failure``
    case : what it calls the function with, where mistakes that break it show; None if that is any case
    dtypes : of the batches that it is tried with
    at_ends : what it looks at in calls at the ends of what is legal; None if it isn't looked at there
    beside : a law that always comes with it
    """

    name: str
    title: str
    run: "Callable[[Function, Trial], None]"
    role: Role = "corner"
    kind: Kind = "property"
    points: float = 1.0
    false_fail: float = 0.0
    case: Case | None = None
    dtypes: tuple[Any, ...] = DTYPES
    at_ends: Callable[["Arguments", Any], None] | None = None
    beside: "Law | None" = None


@dataclass(frozen=True)
class Function:
    """One function of the course.

    Attributes
    ----------
    name, arguments, results, laws : of the function
    case : arguments that hang on each other; those that it leaves out are made as declared
    corners : further arguments at the ends of what is legal, of a dtype
    columns : whether each column of the results depends on that column of the arguments alone
    free : whether rows and senses of ``u`` may be used in any way
    symmetric : whether the axes of the result may be exchanged as well
    unique : whether the arguments, or the distribution of what they give, leave one right result
    features : (arguments, results) -> (k, N) numbers whose distribution tells mistakes of functions that are free
    scales : factors of all lengths that the conventions are tried with
    speed : columns of a call whose time is compared; 0 for none
    most : columns of any call; few where a right way may take a tenth of a second for one
    """

    name: str
    arguments: tuple[Argument, ...]
    results: tuple[ResultContract, ...]
    laws: tuple[Law, ...]
    case: Case | None = None
    corners: tuple[Callable[[Any], Mapping[str, Any]], ...] = ()
    columns: bool = True
    free: bool = False
    symmetric: bool = False
    unique: bool = True
    features: Callable[[Arguments, Any], Array] | None = None
    scales: tuple[float, ...] = (1.0, 1e-6, 1e6)
    speed: int = 16384
    most: int = 1 << 20

    def argument(self, name: str) -> Argument:
        """The argument of that name."""
        return next(argument for argument in self.arguments if argument.name == name)

    @property
    def draws(self) -> bool:
        """Whether it draws its numbers by itself, in any order: then values tell nothing, but features may."""
        return any(argument.name == "rng" for argument in self.arguments)

    def make(self, draw: Draw, case: Case | None = None) -> Arguments:
        """Legal arguments: a case's, and the others as they are declared; batches have the dtype that was asked for."""
        case, draw = case or self.case, replace(draw, n=min(draw.n, self.most))
        given = dict(case(draw)) if case else {}
        found = Arguments()
        for argument in self.arguments:
            name = argument.name
            if name not in given:
                assert argument.make, f"it isn't said how values of {name} are made"
                given[name] = argument.make(draw)
            batch, value = _is_batch(argument, given[name]), given[name]
            found[name] = np.ascontiguousarray(value, draw.dtype) if batch else value
        return found

    def ends(self, draw: Draw) -> list[Arguments]:
        """Arguments at the ends of what is legal: its extremes and its corners."""
        return self.extremes(draw) + [
            self.make(draw, lambda _, corner=corner: corner(draw.dtype))  # type: ignore[misc]
            for corner in self.corners
        ]

    def extremes(self, draw: Draw) -> list[Arguments]:
        """Columns of numbers at the ends of what is legal, as many as it takes, beside others that are as usual."""
        # What a case makes hangs on its other arguments, and has no ends of its own.
        hanging = set(self.case(draw)) if self.case else set()
        ended = [one for one in self.arguments if one.corners and one.name not in hanging]
        if not ended:
            return []
        ends = [argument.corners(draw.dtype) for argument in ended if argument.corners]
        sizes = [end.shape[-1] for end in ends]
        # Not all pairs of hundreds of directions: every so manieth, and with no common divisor, all of each.
        pairs = prod(sizes)
        step = max(1, pairs // 997)
        while any(gcd(step, size) > 1 for size in sizes):
            step += 1
        index = np.unravel_index(np.arange(0, pairs, step), sizes)
        a = self.make(draw.but(n=len(index[0])))
        for argument, end, chosen in zip(ended, ends, index, strict=True):
            a[argument.name] = np.ascontiguousarray(end[..., chosen])
        return [a]

    def call(self, trial: Trial, a: Arguments) -> Any:
        """The results, of right shapes and finite, floating ones in float64; a tuple if there are several.

        Raises Failure, StudentError.
        """
        # Generators move when they are drawn from: each call gets one that hasn't.
        given = (deepcopy(v) if isinstance(v, np.random.Generator) else v for v in a.values())
        return self.seen(trial.call(*given), a)

    def seen(self, value: Any, a: Arguments, dtype: Any = None) -> Any:
        """Results of a call, looked at: of right shapes and finite; floating ones in float64.

        Raises Failure.
        ``dtype``: of the batch arguments, to be looked at too; any floating one passes if not given
        """
        several = len(self.results) > 1
        value = unstacked(value, len(self.results))
        if several and (not isinstance(value, tuple | list) or len(value) != len(self.results)):
            names = ", ".join(result.name for result in self.results)
            raise Failure(f"{len(self.results)} results: {names}", described(value))
        parts = value if several else (value,)
        sizes = self.sizes(a)
        batches = [one.name for one in self.arguments if _is_batch(one, a[one.name])]
        looked = tuple(
            _looked(part, result, sizes, dtype, batches)
            for part, result in zip(parts, self.results, strict=True)
        )
        return looked if several else looked[0]

    def sizes(self, a: Arguments) -> dict[str, int]:
        """Words of the shapes, and whole arguments, with their values in a call."""
        found: dict[str, int] = {}
        for argument in self.arguments:
            value = a[argument.name]
            if argument.sizes:
                sized = zip(argument.sizes, np.shape(value), strict=False)
                found |= {word: size for word, size in sized if not word.isdigit()}
            elif isinstance(value, int | np.integer):
                found[argument.name] = int(value)
        return found

    def shapes(self, arguments: Iterable[Any]) -> tuple[tuple[int, ...], ...] | None:
        """Of the results of a call; None where they are up to the function, or the arguments are none for it."""
        a = Arguments(zip((argument.name for argument in self.arguments), arguments, strict=False))
        for argument in self.arguments:
            # Where the first axis may be left out and is no number, the others don't say what the results' are.
            first = argument.sizes[0] if argument.sizes else "1"
            value: Any = a.get(argument.name) if argument.sizes else None
            if np.ndim(value) < len(argument.sizes) and not first.isdigit():
                return None
        try:
            shapes = [result.sized(self.sizes(a)) for result in self.results]
        except Exception:  # noqa: BLE001 - arguments of a wrong shape, for which the function has to raise
            return None
        # What no argument says is up to the function.
        known = all(isinstance(size, int) for shape in shapes for size in shape)
        return tuple(shapes) if known else None  # type: ignore[arg-type]

    def promoted(self, a: Arguments) -> Any:
        """The dtype of the batch arguments, as NumPy promotes them; None if there are none."""
        pairs = ((argument, a[argument.name]) for argument in self.arguments)
        kinds = [value.dtype for argument, value in pairs if _is_batch(argument, value)]
        return np.result_type(*kinds) if kinds else None


def _is_batch(argument: Argument, value: Any) -> bool:
    """Whether it is an array of floating numbers whose dtype is the results'."""
    floating = isinstance(value, np.ndarray) and value.dtype.kind == "f"
    return bool(argument.batch) and floating and value.ndim == len(argument.sizes)


def function(
    path: str, made: Mapping[str, Made], laws: tuple[Law, ...], *, contract: str = "", **how: Any
) -> Function:
    """A function, with the arguments and results of its contract.

    Parameters
    ----------
    path : "module.function"
    made : how arguments are made; of what isn't there, as usual
    contract : as in ``course.engine.functions.signatures``, which has those of all functions that the renderer calls
    how : ``case`` and what follows it in ``Function``
    """
    held = parsed(contract or CONTRACTS[path])
    arguments = []
    for name, shape in held.arguments:
        sizes = tuple(shape.split())
        own = made.get(name) or _usual(name, sizes)
        batch = not all(map(str.isdigit, sizes)) if own.batch is None else own.batch
        arguments.append(Argument(**{**vars(own), "batch": batch}, name=name, sizes=sizes))
    return Function(path.partition(".")[2], tuple(arguments), held.results, laws, **how)


def unstacked(value: Any, count: int) -> Any:
    """Several results that were handed back as one array, as a tuple; whatever else came as it is."""
    if count > 1 and isinstance(value, np.ndarray) and value.ndim:
        return tuple(value) if len(value) == count else value
    return value


def described(value: Any) -> str:
    """What came, for a report: the type, and of arrays shape and dtype."""
    if isinstance(value, tuple | list):
        return f"a {type(value).__name__} of {', '.join(map(described, value)) or 'nothing'}"
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape} and dtype {value.dtype}"
    return f"a {type(value).__name__}"


_NUMBERS = {"int": "iu", "floating": "f"}


def _looked(
    value: Any, result: ResultContract, sizes: dict[str, int], dtype: Any, batches: Sequence[str]
) -> Array:
    if not result.sizes and not isinstance(value, np.ndarray):
        value = _number(value, result)
    if type(value) is not np.ndarray:
        raise Failure(f"{result.name} to be an ndarray", described(value))
    for axis, size in enumerate(result.sizes):
        if isinstance(size, str):
            # A size that no argument has is up to the function; its other results have to agree.
            sizes.setdefault(size, value.shape[axis] if axis < value.ndim else 1)
    shape = result.sized(sizes)
    if value.shape != shape:
        raise Failure(f"{result.name} of shape {shape}", f"shape {value.shape}")
    wanted = dtype if result.dtype is None else result.dtype
    kinds = _NUMBERS.get(wanted) if isinstance(wanted, str) else None
    if kinds is None and wanted is not None and dtype is not None and value.dtype != wanted:
        own = result.dtype is not None or not batches
        hint = f"Cast at the end: result.astype(np.{np.dtype(wanted)})." if own else _cast(batches)
        raise Failure(
            f"{result.name} of dtype {np.dtype(wanted)}",
            f"{value.dtype}",
            hint=hint,
            slip="other-dtype",
        )
    of_kind = value.dtype.kind in (kinds or ("b" if wanted is np.bool_ else "fiu"))
    # What is of another kind of number costs the contract alone.
    if not of_kind and (dtype is not None or value.dtype.kind not in "bfiu"):
        raise Failure(
            f"{result.name} of dtype {wanted or 'floating'}", f"{value.dtype}", slip="other-dtype"
        )
    if not result.endless and not np.isfinite(value).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(value))[0])
        raise Failure(f"{result.name} to be finite", f"{value[index]}", f"at index {index}")
    # Truth values are taken for the numbers 0 and 1, which can be subtracted; whole numbers for what indexes.
    whole = kinds == "iu" and not (value % 1).any()
    kind = bool if wanted is np.bool_ else np.int64 if whole else np.float64
    return value.astype(kind) if kind is bool or value.dtype.kind in "fb" else value


def _cast(batches: Sequence[str]) -> str:
    """How a result gets the dtype of its batch arguments."""
    several = len(batches) > 1
    dtype = f"np.result_type({', '.join(batches)})" if several else f"{batches[0]}.dtype"
    return (
        f"The dtype of a result is that of {' and '.join(batches)}; single points and numbers, NumPy's own too, "
        f"never change it. Cast at the end: result.astype({dtype})."
    )


def _number(value: Any, result: ResultContract) -> Any:
    if isinstance(value, bool | np.bool_) or not isinstance(
        value, int | float | np.integer | np.floating
    ):
        raise Failure(f"{result.name} to be a number", described(value))
    return np.asarray(value)


# ---------------------------------------------------------------- where declarations are found


@cache
def declarations(module: str) -> tuple[Function, ...]:
    """Those of a module's functions; empty for what is no module of the course."""
    if module not in COURSE:
        return ()
    declared: tuple[Function, ...] = import_module(
        f"course.school.grading.modules.{module}"
    ).FUNCTIONS
    return declared


def declaration(module: str, name: str) -> Function | None:
    """That of one function; None where there is none."""
    return next((function for function in declarations(module) if function.name == name), None)


def declared_function(module: str, name: str) -> Function:
    """That of a function of the course."""
    found = declaration(module, name)
    assert found is not None, f"{module}.{name}"
    return found
