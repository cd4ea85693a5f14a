"""Messages about calls that gave no value: they hold only as much of the student's own texts as somebody reads."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course.engine.functions.modules import COURSE, meant
from course.school.grading.checks.declare import declaration
from course.school.grading.errors import StudentError, Trouble
from course.school.grading.worker.framing import LARGEST_INTEGER, Passed

LONGEST_MESSAGE = 300
LONGEST_LINE = 160
LONGEST_TRACEBACK = 3000
"""Characters of an exception's text, of one line of its traceback, and of all its lines."""

LONGEST_TYPE, LONGEST_TEXT = 80, 600
"""Characters of the exception's class, and of a text that is looked through: the time grows with its square."""

ONE_EACH = "(a * b).sum(axis=0) gives the dot product of each column"

REMEDIES = {
    rf"No module named '({'|'.join(COURSE)}|assignments)['.]": (
        "Each module is checked by itself, without the files beside it: "
        "copy the helper into this file."
    ),
    r"No module named|relative import|not allowed while grading: (import |opening .*__init__)": (
        "While functions are checked there are NumPy and Python's own library, such as math, and nothing else: "
        "copy helpers into this file, and import what draws, renders or compiles in another one, which calls it."
    ),
    r"not allowed while grading": (
        "While functions are checked they read and write no files, and start no programs: "
        "all that they need comes with their arguments."
    ),
    r"codec can't decode|Non-UTF-8 code|null bytes": (
        "The file is not saved as UTF-8: save it anew with that encoding, which editors ask for or show at the bottom."
    ),
    r"EOF when reading a line|BdbQuit": (
        "Nobody can type while functions are checked: print shows values, and a file of your own that calls the "
        "function can be stopped in a debugger."
    ),
    r"SystemExit": "exit() ends the whole program: a function ends with return.",
    r"name '(math|cmath|itertools|functools|random)' is not defined": (
        "A module of Python's own library has to be imported at the top of the file. "
        "NumPy's functions (np.sqrt, np.cos) take whole batches."
    ),
    r"shapes? .* not aligned|mismatch in its core dimension": (
        f"np.dot and @ multiply matrices, not the columns of two batches: {ONE_EACH}."
    ),
    r"truth value of an array": (
        "if, and, or, not, min and max take one number, and this is a batch: np.where chooses for each column, "
        "& and | join conditions, np.minimum and np.maximum compare."
    ),
    r"only (length-1|size-1|0-dimensional) arrays can be converted": (
        "float() and the functions of math take one number, and this is a batch: those of NumPy (np.sqrt, np.cos) "
        "take all of it."
    ),
    r"invalid index to scalar|array is 0-dimensional|object is not subscriptable": (
        "A number has no parts to index: which of the arguments are numbers, the line above says. np.linalg.norm, "
        "sum, min and max without axis give a number, too; with axis=0 they give one for each column."
    ),
    (
        r"index \d+ is out of bounds for axis 0|too many indices|not enough values to unpack"
        r"|too many values to unpack|cannot unpack non-iterable"
    ): (
        "The first axis has the coordinates and the last one the columns: u[0] and u[1] are the rows of (2, N), "
        "and u[:, 0] is its first column."
    ),
    r"index -?\d+ is out of bounds for axis [1-9] with size [01]\b": (
        "The last axis has N columns, and N may be 0 or 1: no column can be counted on."
    ),
    r"index -?\d+ is out of bounds for axis [1-9]": (
        "Along an axis of that size, indices go from 0 to one less: how is the largest one made?"
    ),
    r"zero-size array to reduction|attempt to get arg(max|min) of an empty": (
        "N = 0 is a batch, too: the largest or smallest of no columns doesn't exist."
    ),
    r"Cannot cast ufunc": (
        "An operation in place (+=, *=, out=) keeps its array's dtype, and the result is of another: "
        "write a = a * b, and cast to the dtype of the batch in the end."
    ),
    r"instead of numbers or arrays of numbers": (
        "A subclass of NumPy's array, such as a masked array or a matrix, becomes an array by np.array(...)."
    ),
    r"must have the same shape|must match exactly|inhomogeneous shape": (
        "np.stack and np.array take rows of one shape: a number beside batches has to become a batch first, "
        "as np.zeros_like or np.full make one."
    ),
}
"""What the exception's text holds -> what to do; the first that fits is told."""

_SHAPE = re.compile(r"\(((?:\d{1,9}, ?)*\d{0,9})\)")

MOST_PARTS = 6
LONGEST_NUMBER = 24
"""Parts of a tuple, and characters of a number, that are told."""


def replied(kind: Trouble, head: Mapping[str, Any], arguments: str = "") -> StudentError:
    """The error that a worker's reply tells.

    ``arguments``: those of the call, as ``said``
    """
    lines = str(head.get("traceback", ""))[:LONGEST_TRACEBACK].splitlines()
    message, type_ = str(head.get("message", "")), str(head.get("type", ""))[:LONGEST_TYPE]
    return StudentError(
        kind,
        _cut(message, LONGEST_MESSAGE),
        type_,
        "\n".join(_cut(line, LONGEST_LINE) for line in lines),
        arguments=arguments if kind == "raised" else "",
        remedy=remedy(f"{type_}: {message[:LONGEST_TEXT]}")
        if kind in ("raised", "bad value")
        else "",
    )


def said(function: str, arguments: Sequence[Any], named: Mapping[str, Any]) -> str:
    """The arguments of a call in a line: ``center (3,) float64, radius 0.5, u (2, 17) float32``.

    ``function``: "soft_shadows.point_on_sphere"
    """
    declared = declaration(*function.split(".", 1)) if "." in function else None
    names = [argument.name for argument in declared.arguments] if declared else []
    names += [f"argument {number + 1}" for number in range(len(names), len(arguments))]
    pairs = [*zip(names, arguments, strict=False), *named.items()]
    return _cut(", ".join(f"{name} {told(value)}" for name, value in pairs), LONGEST_MESSAGE)


def told(value: Any, depth: int = 1) -> str:
    """The kind of a value in a few words; of tuples in tuples only how long they are."""
    if isinstance(value, tuple | list):
        kind = f"a tuple of {len(value)}"
        parts = [told(part, depth - 1) for part in value[:MOST_PARTS]] if depth else []
        parts += ["..."] * (len(value) > MOST_PARTS)
        return f"{kind} ({', '.join(parts)})" if depth else kind
    if isinstance(value, np.ndarray):
        return f"{value.shape} {value.dtype}"
    if isinstance(value, np.random.Generator | Passed):
        return "a generator"
    if isinstance(value, np.generic):
        return f"{str(value)[:LONGEST_NUMBER]} {value.dtype}"
    if type(value) is int and abs(value) >= LARGEST_INTEGER:
        return "a whole number of more than 64 bits"
    if type(value) in (bool, int, float):
        return str(value)[:LONGEST_NUMBER]
    return "None" if value is None else f"a {type(value).__name__}"


def no_such(module: str, function: str, names: Any) -> StudentError:
    """That the file hasn't this function, and which one may have been meant.

    ``names``: what the worker says that the file has; nothing of it is believed
    """
    others = [
        name
        for name in (names if isinstance(names, list) else [])
        if isinstance(name, str) and len(name) < 80 and name.isidentifier()
    ]
    others = [name for name in others if name not in COURSE.get(module, ())]
    near = meant(function, others)
    hint = f" (did you mean {near}?)" if near else ""
    return StudentError("missing", f"{module}.py has no {function}{hint}")


def not_loaded(module: str, error: StudentError, seconds: float, over: str = "") -> StudentError:
    """The error of every function of a file whose import has ended with this one.

    Parameters
    ----------
    seconds : that the import was given
    over : that the submission's time has ended it; empty if it hasn't
    """
    message = f"{module}.py can't be imported: {error.type + ': ' if error.type else ''}{error}"
    if error.kind == "timeout":
        message = (
            f"the import of {module}.py hadn't ended yet, and {over}"
            if over
            else f"the import of {module}.py doesn't end within {seconds:g} s"
        )
    kind = error.kind if error.kind in ("timeout", "crashed") else "not loaded"
    return StudentError(
        kind, message, error.type, error.traceback, module_wide=True, remedy=error.remedy
    )


def _cut(text: str, longest: int) -> str:
    return text if len(text) <= longest else f"{text[:longest]} ... (cut)"


def remedy(message: str) -> str:
    """The remedy of an exception with this text; empty where none is known."""
    if "could not be broadcast" in message:
        return _broadcast([_sizes(shape) for shape in _SHAPE.findall(message)])
    return next((text for pattern, text in REMEDIES.items() if re.search(pattern, message)), "")


def _sizes(shape: str) -> tuple[int, ...]:
    return tuple(int(size) for size in shape.split(",") if size.strip())


def _broadcast(shapes: Sequence[tuple[int, ...]]) -> str:
    """The remedy of shapes that don't go together."""
    if len(shapes) < 2:
        return "NumPy lines shapes up at their ends: each pair of sizes has to be equal, or one of them 1."
    a, b = sorted(shapes[:2], key=len)
    if len(a) == len(b) == 2 and a == b[::-1]:
        turned, right = (b, a) if a[0] in (2, 3) else (a, b)
        return (
            f"{turned} is {right} turned over: a batch has its coordinates in the first axis and its N columns in "
            "the last, so (2, N) or (3, N)."
        )
    if len(a) == 1 and len(b) == 2 and a[0] == b[0]:
        return (
            f"{a} and {b}: NumPy lines shapes up at their ends. A single point needs a second axis to go with "
            "the columns of a batch: point[:, None]. If it is a length: np.linalg.norm with axis=0 gives one for "
            "each column, with axis=1 one for each row."
        )
    if len(a) == len(b) == 1:
        return f"{a} and {b}: a single point and a number for each column make a batch as point[:, None] * numbers."
    return (
        f"{a} and {b}: NumPy lines shapes up at their ends; each pair of sizes has to be equal, or one of them 1. "
        "Batches are (2, N) or (3, N), numbers of a batch (N,), single points (3,)."
    )
