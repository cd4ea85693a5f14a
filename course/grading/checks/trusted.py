"""Calls of functions that need no worker: the reference solution's, and variants of the course's own."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from course.grading.errors import StudentError


class TrustedModule:
    """A ``Caller`` in this process.

    ``functions``: by name
    """

    def __init__(self, functions: Mapping[str, Callable[..., Any]]) -> None:
        self._functions = functions

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value; what it raises becomes a ``StudentError`` as a worker's would."""
        try:
            return self._functions[function](*arguments, **named)
        except NotImplementedError as error:
            raise StudentError("not written", str(error)) from error
        except Exception as error:
            raise StudentError("raised", str(error), type(error).__name__) from error

    def call_and_look(self, function: str, *arguments: Any) -> tuple[Any, list[Any], bool]:
        """The value, the arguments afterwards, and whether NumPy's global random state moved."""
        before = _state()
        value = self.call(function, *arguments)
        return value, list(arguments), _state() != before


def _state() -> tuple[bytes, str]:
    state = np.random.get_state(legacy=False)  # noqa: NPY002
    # As text its 624 words would take a millisecond, which is more than most calls take.
    key = state["state"].pop("key", b"")
    return bytes(key), repr(state)
