"""What is said of a call that gave no value: of the student's own texts only as much as somebody reads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course.grading.checks.declarations import declaration
from course.grading.errors import StudentError, Trouble, meant
from course.grading.worker.framing import LARGEST_INTEGER, Passed
from course.grading.worker.remedies import remedy
from course.modules import COURSE

LONGEST_MESSAGE = 300
LONGEST_LINE = 160
LONGEST_TRACEBACK = 3000
"""Characters of an exception's text, of one line of its traceback, and of all its lines."""

MOST_PARTS = 6
LONGEST_NUMBER = 24
"""Parts of a tuple, and characters of a number, that are told."""


def replied(kind: Trouble, head: Mapping[str, Any], arguments: str = "") -> StudentError:
    """The error that a worker's reply tells.

    Parameters
    ----------
    arguments : those of the call, as ``said``
    """
    lines = str(head.get("traceback", ""))[:LONGEST_TRACEBACK].splitlines()
    message = str(head.get("message", ""))
    return StudentError(
        kind,
        _cut(message, LONGEST_MESSAGE),
        str(head.get("type", ""))[:80],
        "\n".join(_cut(line, LONGEST_LINE) for line in lines),
        arguments=arguments if kind == "raised" else "",
        remedy=remedy(message) if kind == "raised" else "",
    )


def said(function: str, arguments: Sequence[Any], named: Mapping[str, Any]) -> str:
    """The arguments of a call in a line: ``center (3,) float64, radius 0.5, u (2, 17) float32``.

    Parameters
    ----------
    function : "soft_shadows.point_on_sphere"
    """
    declared = declaration(*function.split(".", 1)) if "." in function else None
    names = [argument.name for argument in declared.arguments] if declared else []
    names += [f"argument {number + 1}" for number in range(len(names), len(arguments))]
    pairs = [*zip(names, arguments, strict=False), *named.items()]
    return _cut(", ".join(f"{name} {told(value)}" for name, value in pairs), LONGEST_MESSAGE)


def told(value: Any, depth: int = 1) -> str:
    """What kind of value it is, in a few words; of tuples in tuples only how long they are."""
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

    Parameters
    ----------
    names : what the worker says that the file has; nothing of it is believed
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
    """What is raised for every function of a file whose import has ended with this error.

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
    return StudentError(kind, message, error.type, error.traceback, module_wide=True)


def _cut(text: str, longest: int) -> str:
    return text if len(text) <= longest else f"{text[:longest]} ... (cut)"
