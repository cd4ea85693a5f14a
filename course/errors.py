"""Errors that are the input's fault: shown as one message that names the place and the remedy."""

from __future__ import annotations


class CourseError(Exception):
    """A mistake in what the user gave; its message is shown without a traceback."""


class CourseWarning(UserWarning):
    """Something doubtful in the input, and what has been made of it; the message names the place."""


class SceneError(CourseError):
    """A scene file that can't be rendered; the message names file, line and key path."""


class GeometryError(CourseError):
    """A mesh that can't be used; the message names the file and the trouble."""


class EffectError(CourseError):
    """A student function that is missing, not written yet, or returned what it must not."""


class OutputError(CourseError):
    """A picture or a report that can't be written."""
