"""`<!-- site: diagram MODULE/NAME -->`: a figure in the page."""

from functools import cache
from importlib import import_module

from course.base.errors import CourseError
from sitebuild.diagrams.figure import Figure, html
from sitebuild.place import Place


def diagram(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Draw a figure into the page."""
    return html(figure(name), "figure-" + name.replace("/", "-").replace("_", "-"))


@cache
def figure(name: str) -> Figure:
    """The figure MODULE/NAME."""
    module, _, figure_name = name.partition("/")
    figures = import_module(f"sitebuild.diagrams.{module}").FIGURES
    if figure_name not in figures:
        raise CourseError(f"{name}: no such figure; there are {', '.join(figures)}")
    return figures[figure_name]()
