"""Regions of a solution: the lines that students are to write themselves.

A region runs from a line ``### BEGIN SOLUTION`` to the next ``### END SOLUTION``, each alone on its line and both
indented alike. Lines are read as text, not as Python, so that nothing can hide a marker; what nearly is a marker is
refused rather than overlooked, for the price of overlooking one is a published solution.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from course.errors import CourseError

BEGIN = "### BEGIN SOLUTION"
END = "### END SOLUTION"

_NEARLY = re.compile(r"#.*\b(begin|end)[\s_-]*solution", re.IGNORECASE)


class SolutionError(CourseError):
    """A solution from which no stub can be made; the message names file and line."""


@dataclass(frozen=True)
class Region:
    """Where one region stands.

    Attributes
    ----------
    begin, end : int
        Numbers of the lines that hold the two markers, counted from 1.
    indent : str
        The white space before both.
    """

    begin: int
    end: int
    indent: str


def find_regions(text: str, file: str) -> list[Region]:
    """Find the regions of a text, from top to bottom.

    Parameters
    ----------
    text : str
    file : str
        What error messages call the text.

    Returns
    -------
    list of Region

    Raises
    ------
    SolutionError
        A region is not closed, begins within another or ends without having begun; its markers
        are indented differently; or a marker is misspelt or shares its line.
    """
    regions = []
    opened: tuple[int, str] | None = None
    for number, line in enumerate(text.split("\n"), start=1):
        marker = line.strip()
        indent = line[: len(line) - len(line.lstrip())]
        if marker == BEGIN:
            if opened:
                raise SolutionError(
                    f"{file}:{number}: a region begins inside the one that line {opened[0]} opened"
                )
            opened = number, indent
        elif marker == END:
            if not opened:
                raise SolutionError(f"{file}:{number}: {END!r} closes no region")
            if indent != opened[1]:
                raise SolutionError(
                    f"{file}:{number}: {END!r} is not indented like its beginning in line {opened[0]}"
                )
            regions.append(Region(opened[0], number, indent))
            opened = None
        elif _NEARLY.search(line):
            raise SolutionError(
                f"{file}:{number}: {marker!r} is no marker: "
                f"expected {BEGIN!r} or {END!r}, alone on its line"
            )
    if opened:
        raise SolutionError(f"{file}:{opened[0]}: the region that begins here is never closed")
    return regions
