"""Which known mistake a function makes: the one of a wrong submission that behaves alike.

A known wrong submission (``solutions/wrong``) leaves a print: what its function gives for the probes, fixed arguments
that come from the function's declaration. A student's function that gives the same for all probes makes the same
mistake. Where rows and senses of u are free, u is tried in every order and sense; where that isn't enough, as numbers
may be used in any way, the distributions of the declared features are compared. Prints are arrays, so a student's copy
has them without the submissions.
"""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import deepcopy
from functools import cache, lru_cache
from importlib.resources import files
from itertools import count, permutations, product
from typing import Any
from unittest.mock import patch

import numpy as np
from msgspec import msgpack

from course.school.grading.checks.check import Array, Caller, Check, ModuleChecks, References, Trial
from course.school.grading.checks.declare import Arguments, Function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import exact
from course.school.grading.errors import StudentError
from course.school.grading.known import KnownSubmission, known, trusted
from course.school.grading.modules.generators import drawn

PROBED = 24
"""Columns of a probe."""

MOST = 3000
"""Numbers of a result from which on it is thinned."""

NEAR = 1e-3
"""Of a value, and of the typical one of its probe: that near are values that are alike."""

FEATURED, QUANTILES = 4000, 129
"""Columns whose features are compared, and numbers that a distribution is kept as."""

CLOSE = 0.05
"""Largest distance of two distributions of features that are alike (Kolmogorov and Smirnov); right ones of so many
columns are farther from their own distribution once in a billion."""

SLIPS = {
    "writes-to-arguments": "An array that was handed in holds other numbers after the call: "
    "the function works in the caller's memory.",
    "global-random-state": "NumPy's global random state is another one after the call, "
    "and so are the numbers of everybody who uses it.",
    "overwrites-results": "An array that an earlier call has returned holds other numbers after the next one: "
    "the function hands out the same memory again.",
    "other-dtype": "The values may be right; the result has another dtype than was agreed for these arguments.",
    "not-refused": "Arguments that can't be right give a result, and so a wrong picture that nobody is told of.",
    "not-by-its-column": "A column's result hangs on more than its own arguments: "
    "on other columns, on its place in the batch, or on numbers drawn elsewhere.",
    "remembers-calls": "The same call gives another result the second time: something of the first is kept.",
}
"""Mistakes that a failure shows by itself, in whatever function, and what the student is told."""

Probed = Iterable[tuple[str, Arguments]]
"""All of ``probes``, made once for all submissions of a function."""

Print = Mapping[str, Array]
"""What is kept of a submission: by probe, of its features, and what the student is told."""


def probes(function: Function) -> Iterator[tuple[str, Arguments]]:
    """Arguments, the same in every process: of every law's case, at two scales, in both dtypes, and at the ends."""
    cases = [None, *dict.fromkeys(law.case for law in function.laws if law.case is not None)]
    for number, case in enumerate(cases):
        for dtype, scale in ((np.float64, 1.0), (np.float32, 3.0)):
            rng = np.random.default_rng((17, number))
            yield (
                f"{number}/{np.dtype(dtype)}",
                function.make(Draw(rng, PROBED, dtype, scale), case),
            )
    for number, a in enumerate(function.ends(Draw(np.random.default_rng(18), 1, np.float64))):
        yield f"end/{number}", _fewer(function, a)


def _fewer(function: Function, a: Arguments) -> Arguments:
    """At most 60 columns of them."""
    for argument in function.arguments:
        # One value for all columns has no such axis.
        if argument.axis is not None and np.ndim(a[argument.name]) > argument.axis:
            size = a[argument.name].shape[argument.axis]
            chosen = np.arange(0, size, max(1, size // 60))
            a[argument.name] = np.ascontiguousarray(a[argument.name].take(chosen, argument.axis))
    return a


def taken(function: Function, caller: Caller, probed: Probed) -> dict[str, Array]:
    """The print of somebody's function; ``probed``: all of ``probes``, which are left as they are."""
    found: dict[str, Array] = {}
    for name, a in probed:
        for part, array in _outcome(caller, function, deepcopy(a)).items():
            found[f"{name}:{part}"] = array
    features = _features(function, caller)
    if features is not None:
        at = np.linspace(0, 1, QUANTILES)
        found["features"] = np.quantile(features, at, axis=1).T.astype(np.float32)
    return found


def _outcome(caller: Caller, function: Function, a: Arguments) -> dict[str, Array]:
    """What one call gives: values by number, dtypes; or the kind of exception."""
    given = [value.copy() if isinstance(value, np.ndarray) else value for value in a.values()]
    try:
        value, after, _ = caller.call_and_look(function.name, *given)
    except StudentError as error:
        if error.kind in ("timeout", "crashed"):
            raise
        return {"error": np.array(error.type or error.kind)}
    parts = value if isinstance(value, tuple | list) else (value,)
    found = {}
    try:
        with np.errstate(all="ignore"):
            for number, part in enumerate(parts):
                if isinstance(part, tuple | list):
                    for inner, piece in enumerate(part):
                        found[f"{number}.{inner}"] = np.asarray(piece, np.float64).astype(
                            np.float32
                        )
                    continue
                array = np.asarray(part)
                found[f"{number}"] = _thinned(array).astype(np.float64).astype(np.float32)
                found[f"{number}.dtype"] = np.array(str(array.dtype))
    except (TypeError, ValueError, OverflowError):
        return {"error": np.array("no numbers")}
    wrote = any(
        isinstance(new, np.ndarray) and not np.array_equal(new, old, equal_nan=True)
        for new, old in zip(after, a.values(), strict=True)
    )
    return found | ({"wrote": np.array(True)} if wrote else {})


def _thinned(array: Array) -> Array:
    """Of a large array every so manieth column, from the last on: where a sum ends shows most of it."""
    step = array.size // MOST
    return array[..., ::-step] if step > 1 and array.ndim else array


def _features(function: Function, caller: Caller, axes: bool = False) -> Array | None:
    if function.features is None:
        return None
    a = function.make(Draw(np.random.default_rng(19), FEATURED, np.float64))
    trial = Trial(function.name, caller, np.random.default_rng(0))
    try:
        with np.errstate(all="ignore"):
            r, numbers = _lenient(function, trial, a, axes)
            found = np.asarray(function.features(Arguments(exact(a) | numbers), r), np.float64)
            if function.draws:
                found = np.concatenate((found, _habits(function, trial, a, found.shape[1])))
    except StudentError as error:
        if error.kind in ("timeout", "crashed"):
            raise
        return None
    except Exception:  # noqa: BLE001 - results that have no features are alike to nothing
        return None
    return found if np.isfinite(found).all() else None


def _habits(function: Function, trial: Trial, a: Arguments, n: int) -> Array:
    """(2, n) of whether an equal generator gives the same again, and whether dtypes are those of the contract."""
    value, again = (trial.call(*deepcopy(list(a.values()))) for _ in range(2))
    parts, others = (one if isinstance(one, tuple | list) else (one,) for one in (value, again))
    same = all(np.array_equal(one, other) for one, other in zip(parts, others, strict=True))
    wanted = [one.dtype or function.promoted(a) or np.float32 for one in function.results]
    typed = all(
        isinstance(kind, str) or np.asarray(one).dtype == kind
        for one, kind in zip(parts, wanted, strict=True)
    )
    return np.repeat([[float(same)], [float(typed)]], n, axis=1)


def _lenient(
    function: Function, trial: Trial, a: Arguments, axes: bool
) -> tuple[Any, dict[str, int]]:
    """Results of whatever shape, and how many numbers were drawn for them: of ``rng`` as ``rng_drawn``."""
    given = deepcopy(a)
    value, after, _ = trial.caller.call_and_look(function.name, *given.values())
    numbers = {
        f"{name}_drawn": drawn(old.bit_generator.state, new.bit_generator.state)
        for (name, old), new in zip(a.items(), after, strict=True)
        if isinstance(old, np.random.Generator)
    }
    parts = value if isinstance(value, tuple | list) else (value,)
    looked = tuple(np.asarray(part, np.float64)[:: -1 if axes else 1] for part in parts)
    return looked if len(function.results) > 1 else looked[0], numbers


def matching(
    function: Function, caller: Caller, wrong: Sequence[tuple[str, Print]], right: Print
) -> str:
    """The name of the mistake that the function makes; empty if it is none of these, or if two fit.

    Parameters
    ----------
    caller : of the student's module
    wrong : names of mistakes of this function, with the prints of submissions that make them
    right : the reference solution's print: a mistake is told by what differs from it
    """
    if not wrong:
        return ""
    own = _Own(function, caller)
    found: set[str] = set()
    if function.features is None or not function.draws:
        found = {name for name, kept in wrong if own.is_like(kept, right)}
    found = found or own.by_features(wrong, right)
    return found.pop() if len(found) == 1 else ""


class _Own:
    """The student's outcomes, asked for once."""

    def __init__(self, function: Function, caller: Caller) -> None:
        self.function, self.caller = function, caller
        self._kept: dict[tuple[int, str], dict[str, Array]] = {}
        self._probes = dict(probes(function))
        self.turns = list(_turns(function))
        self._axes = (False, True) if function.symmetric else (False,)

    def is_like(self, other: Print, right: Print) -> bool:
        """Whether all outcomes are those of a submission, with u in some order and sense."""
        telling = [
            name for name in self._probes if not _same(_of(other, name), _of(right, name), True)
        ]
        if not telling:
            return False
        # What tells them apart comes first: most are unlike at once.
        order = [*telling, *(name for name in self._probes if name not in telling)]
        strict = _by_dtype(other, right, self._probes)
        # The ends of [0, 1) are not each other's mirror images: 1 - u loses the smallest numbers.
        inner = [name for name in order if not name.startswith("end/")]
        tried = [(0, order), *((turn, inner) for turn in range(1, len(self.turns)))]
        return any(
            all(
                _same(_turned(self._outcome(turn, name), axes), _of(other, name), strict)
                for name in names
            )
            for turn, names in tried
            if names[0] in telling
            for axes in self._axes
        )

    def _outcome(self, turn: int, name: str) -> dict[str, Array]:
        if (turn, name) not in self._kept:
            a = self._probes[name]
            turned = Arguments(a | {"u": self.turns[turn](a["u"])}) if turn else Arguments(a)
            self._kept[turn, name] = _outcome(self.caller, self.function, turned)
        return self._kept[turn, name]

    def by_features(self, wrong: Sequence[tuple[str, Print]], right: Print) -> set[str]:
        """Mistakes whose features are distributed alike; none where they are as near to what is right."""
        found = [_features(self.function, self.caller, axes) for axes in self._axes]
        features = [each for each in found if each is not None]
        if not features or (
            "features" in right and _distance(features[0], right["features"]) < CLOSE
        ):
            return set()
        return {
            name
            for name, kept in wrong
            if "features" in kept
            and _by_features(kept, right)
            and min(_distance(each, kept["features"]) for each in features) < CLOSE
        }


def _by_features(one: Print, right: Print) -> bool:
    """Whether features tell it from what is right."""
    if "features" not in right:
        return True
    return bool(_quantiles_apart(one["features"], right["features"]) > 2 * CLOSE)


def _distance(features: Array, quantiles: Array) -> float:
    """The largest distance of distributions, row by row."""
    if len(features) != len(quantiles):
        return 1.0
    found = []
    for row, kept in zip(features, quantiles, strict=True):
        slack = 1e-4 * (1 + float(np.abs(kept).max()))
        ordered = np.sort(row)
        share = np.linspace(0, 1, len(kept))
        # Many values may be one: between the shares just below and just above each.
        low = np.searchsorted(ordered, kept - slack, "left") / row.size
        high = np.searchsorted(ordered, kept + slack, "right") / row.size
        found.append(float(np.maximum(np.maximum(low - share, share - high), 0).max()))
    return max(found)


def _quantiles_apart(one: Array, other: Array) -> float:
    return max(_distance(one, other), _distance(other, one))


def _turns(function: Function) -> Iterator[Any]:
    """Every order of the rows of u, each with every sense of each row; the plain one first."""
    yield lambda u: u
    if not function.free:
        return
    word = function.argument("u").sizes[0]
    if not word.isdigit():
        yield _mirrored
        return
    rows = int(word)
    for order in permutations(range(rows)):
        for senses in product((False, True), repeat=rows):
            if order != tuple(range(rows)) or any(senses):
                yield lambda u, order=order, senses=senses: np.stack(
                    [
                        _mirrored(u[k]) if sense else u[k]
                        for k, sense in zip(order, senses, strict=True)
                    ]
                )


def _turned(outcome: Mapping[str, Array], axes: bool) -> Mapping[str, Array]:
    """An outcome, with the axes of the result exchanged or not."""
    if not axes:
        return outcome
    return {key: value[::-1] if value.ndim == 2 else value for key, value in outcome.items()}


def _mirrored(u: Array) -> Array:
    last = np.nextafter(u.dtype.type(1), u.dtype.type(0))
    found: Array = np.clip(1 - u, 0, last)
    return found


def _of(kept: Print, name: str) -> dict[str, Array]:
    start = f"{name}:"
    return {key[len(start) :]: value for key, value in kept.items() if key.startswith(start)}


def _by_dtype(other: Print, right: Print, names: Iterable[str]) -> bool:
    """Whether a submission differs from what is right by dtypes alone."""
    return all(_same(_of(other, name), _of(right, name), False) for name in names)


def _same(one: Mapping[str, Array], other: Mapping[str, Array], dtypes: bool) -> bool:
    """Whether two outcomes are alike: the same exception, or the same values to rounding.

    ``dtypes``: whether those count as well
    """
    ours, theirs = (
        {key: value for key, value in outcome.items() if dtypes or not key.endswith(".dtype")}
        for outcome in (one, other)
    )
    return ours.keys() == theirs.keys() and all(_alike(ours[key], theirs[key]) for key in ours)


def _alike(one: Array, other: Array) -> bool:
    if one.shape != other.shape or one.dtype.kind != other.dtype.kind:
        return False
    if one.dtype.kind != "f":
        return bool((one == other).all())
    finite = np.isfinite(other)
    if not np.array_equal(finite, np.isfinite(one)):
        return False
    if not np.array_equal(one[~finite], other[~finite], equal_nan=True):
        return False
    a, b = one[finite].astype(np.float64), other[finite].astype(np.float64)
    typical = float(np.median(np.abs(b))) if b.size else 0.0
    return bool((np.abs(a - b) <= NEAR * np.maximum(np.abs(b), 0.1 * typical)).all())


# ---------------------------------------------------------------- prints of known submissions


def prints(module: str, function: Function) -> Check:
    """The check whose arrays are the prints of the reference and of a function's known wrong submissions."""

    def prepare(caller: Caller, _: np.random.Generator) -> dict[str, Array]:
        probed = list(probes(function))
        found = {f"/{key}": value for key, value in taken(function, caller, probed).items()}
        for one in known(module):
            if one.mistake not in ("", *SLIPS) and one.function == function.name:
                found |= _print(function, one, probed)
        # One array of all: a file of thousands of small ones takes seconds to write and to open.
        return {"packed": np.frombuffer(_packed(found), np.uint8).copy()}

    return Check(
        function.name, "mistakes", "", lambda _: None, points=0, prepare=prepare, any_seed=True
    )


def _packed(arrays: Mapping[str, Array]) -> bytes:
    rows = [(name, one.dtype.str, one.shape, one.tobytes()) for name, one in arrays.items()]
    return msgpack.encode(rows)


def _print(function: Function, one: KnownSubmission, probed: Probed) -> dict[str, Array]:
    # Some draw numbers of their own: other ones in each call, but the same course gives the same bytes.
    draw, seeds = np.random.default_rng, count()
    seeded = patch(
        "numpy.random.default_rng", lambda seed=None: draw(next(seeds) if seed is None else seed)
    )
    np.random.seed(0)  # noqa: NPY002
    with np.errstate(all="ignore"), seeded:
        arrays = taken(function, trusted(one), probed)
    start = f"{one.mistake}~{one.name}"
    return {f"{start}/{key}": value for key, value in arrays.items()} | {
        f"{start}/says": np.array(one.says)
    }


def mistake_of(
    function: Function, caller: Caller, prints: Mapping[str, Array]
) -> tuple[str, str] | None:
    """Which known mistake somebody's function makes, and what the student is told; None for none.

    ``prints``: as `Check.prepare` of ``ModuleChecks.prints`` made them; without any, nothing is known
    """
    if not prints:
        return None
    grouped = _unpacked(prints["packed"].tobytes())
    wrong = [(start.partition("~")[0], arrays) for start, arrays in grouped.items() if start]
    found = matching(function, caller, wrong, grouped.get("", {}))
    # One of several submissions that make a mistake says it.
    says = (str(arrays["says"]) for name, arrays in wrong if name == found)
    return (found, next(filter(None, says), "")) if found else None


@lru_cache(maxsize=32)
def _unpacked(packed: bytes) -> Mapping[str, Mapping[str, Any]]:
    """Arrays that nobody may write to, by what they are of; whoever grades a class asks for the same often."""
    grouped: dict[str, dict[str, Any]] = {}
    for name, dtype, shape, numbers in msgpack.decode(packed):
        start, _, key = name.partition("/")
        # Bytes can't be written to, and so can't what looks at them.
        grouped.setdefault(start, {})[key] = np.ndarray(shape, dtype, numbers)
    return grouped


# ---------------------------------------------------------------- what a mistake explains


def known_mistake(
    checks: ModuleChecks, function: str, caller: Caller, references: References
) -> tuple[str, str] | None:
    """The known mistake that the function makes, and what the student is told; None for none."""
    if function not in checks.named:
        return None
    prints = references(checks.module, checks.prints[function])
    try:
        return checks.named[function](caller, prints)
    except StudentError:
        return None  # It doesn't end, or ends its process; the next call would be waited for, too.


def explains(module: str, check: Check, mistake: str) -> bool:
    """Whether who makes that mistake fails this check for it.

    ``mistake``: its name; one that nobody has recorded explains all that fails
    """
    checks = _recorded().get(f"{module}.{check.function}/{mistake}")
    return checks is None or check.name in checks


@cache
def _recorded() -> dict[str, list[str]]:
    """What ``python -m benchmarks.mutants --record`` has found."""
    path = files("course.school.grading") / "data" / "explained.json"
    found: dict[str, list[str]] = json.loads(path.read_text(encoding="utf-8"))
    return found
