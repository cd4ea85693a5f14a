"""What is said of a call that gave no value: of the student's own texts only as much as somebody reads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from course.effects import COURSE
from course.grading.errors import StudentError, Trouble, meant

LONGEST_MESSAGE = 300
LONGEST_LINE = 160
LONGEST_TRACEBACK = 3000
"""Characters of an exception's text, of one line of its traceback, and of all its lines."""


def replied(kind: Trouble, head: Mapping[str, Any]) -> StudentError:
    """The error that a worker's reply tells."""
    lines = str(head.get("traceback", ""))[:LONGEST_TRACEBACK].splitlines()
    return StudentError(
        kind,
        _cut(str(head.get("message", "")), LONGEST_MESSAGE),
        str(head.get("type", ""))[:80],
        "\n".join(_cut(line, LONGEST_LINE) for line in lines),
    )


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


def not_loaded(module: str, error: StudentError, seconds: float) -> StudentError:
    """What is raised for every function of a file whose import has ended with this error.

    Parameters
    ----------
    seconds : that the import was given
    """
    message = f"{module}.py can't be imported: {error.type + ': ' if error.type else ''}{error}"
    if error.kind == "timeout":
        message = f"the import of {module}.py doesn't end within {seconds:g} s"
    kind = error.kind if error.kind in ("timeout", "crashed") else "not loaded"
    return StudentError(kind, message, error.type, error.traceback, module_wide=True)


def _cut(text: str, longest: int) -> str:
    return text if len(text) <= longest else f"{text[:longest]} ... (cut)"
