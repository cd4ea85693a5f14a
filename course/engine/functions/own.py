"""Functions of which more is known than their contract says: the course's own, and no student's."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT


class EngineForm:
    """Stands for a function where there are no solutions: compiled loops have their own form of it, nobody else has.

    ``name``: "module.function"
    """

    def __init__(self, name: str) -> None:
        self._name = name

    def __call__(self, *_: Any) -> Any:
        """Raise CourseError."""
        raise CourseError(f"this copy has no solution of {self._name}")


class Watched:
    """A function whose calls are noted down; what is known of the function stays known.

    Parameters
    ----------
    function : what is called
    note : is told arguments and result of each call
    """

    def __init__(
        self, function: Callable[..., Any], note: Callable[[tuple[Any, ...], Any], None]
    ) -> None:
        self.function = function
        self._note = note

    def __call__(self, *arguments: Any) -> Any:
        """Call the function."""
        result = self.function(*arguments)
        self._note(arguments, result)
        return result


def courses_own(function: Callable[..., Any]) -> bool:
    """Whether a function is the project's own solution, or stands for it."""
    if isinstance(function, Watched):
        return courses_own(function.function)
    if isinstance(function, EngineForm):
        return True
    code = getattr(function, "__code__", None)
    return code is not None and Path(code.co_filename).resolve().parent == PROJECT / "solutions"
