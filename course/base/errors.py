"""Errors that are the input's fault: shown as one message that names the place and the remedy."""

from collections.abc import Iterable


class CourseError(Exception):
    """A mistake in what the user gave; its message is shown without a traceback."""

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows of it; see IPython's ``InteractiveShell.showtraceback``."""
        return [f"{type(self).__name__}: {self}"]


class CourseWarning(UserWarning):
    """Something doubtful in the input, and what has been made of it; the message names the place."""


class SceneError(CourseError):
    """A scene file that can't be rendered; the message names file, line and key path."""


class GeometryError(CourseError):
    """A mesh that can't be used; the message names the file and the trouble."""


class EffectError(CourseError):
    """A student function that is missing, not written yet, or returned what it must not."""


class FunctionError(EffectError):
    """A student function that raised an exception or returned what it must not.

    ``function``: "module.function".
    """

    def __init__(self, message: str, function: str) -> None:
        # Both, so that a copy that a cluster sends has both.
        super().__init__(message, function)
        self.function = function

    def __str__(self) -> str:
        return str(self.args[0])

    def asked_by(self, where: str, keys: Iterable[str | int]) -> "FunctionError":
        """The same with the place of the scene that makes the function necessary: file and line, and the key path."""
        place = f"{where}: {'.'.join(map(str, keys))} asks for it"
        # Of two callers, one in the other, each may add it.
        return (
            self if str(self).endswith(place) else FunctionError(f"{self}; {place}", self.function)
        )


class Ended(SystemExit):
    """The process was told to end by a signal."""


class OutputError(CourseError):
    """A picture or a report that can't be written."""
