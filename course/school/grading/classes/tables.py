"""CSV files as spreadsheets and learning systems write them: any of four delimiters, UTF-8 or what a mark says."""

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from course.base.errors import CourseError
from course.base.inputs import LARGEST_SCENE, InputLimit, read_input, shown, text_of

_DELIMITERS = ",;\t|"


@dataclass(frozen=True)
class ClassTable:
    """A table with a heading.

    Attributes
    ----------
    columns : headings, as they came
    rows : number of the line in the file, and as many cells as there are columns
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]

    def records(self) -> Iterator[tuple[int, dict[str, str]]]:
        """The rows by their headings; of two columns with one heading the first counts."""
        for line, cells in self.rows:
            yield line, dict(reversed([*zip(self.columns, cells, strict=True)]))


def read_table(path: Path, what: str) -> ClassTable:
    """Read a CSV file; ``CourseError`` where it can't be read, or a row has more cells than the heading."""
    content = read_input(path, what, InputLimit(LARGEST_SCENE))
    try:
        text = text_of(content)
    except UnicodeError as error:
        told = f"{shown(path)}: can't be read: {error}; save it as CSV in UTF-8"
        raise CourseError(told) from None
    # Excel says in a line of its own what it divides cells by.
    stated = re.match(rf"sep=([{_DELIMITERS}])\r?\n", text)
    above, text = (1, text[stated.end() :]) if stated else (0, text)
    heading = re.sub(r'"[^"]*"', "", text.lstrip().partition("\n")[0])
    delimiter = stated[1] if stated else max(_DELIMITERS, key=heading.count)
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    try:
        found = [(above + rows.line_num, [*map(str.strip, row)]) for row in rows if any(row)]
    except csv.Error as error:
        raise CourseError(f"{shown(path)}:{above + rows.line_num}: {error}") from None
    columns = tuple(found[0][1]) if found else ()
    while columns and not columns[-1]:
        columns = columns[:-1]
    return ClassTable(
        columns, tuple((line, _cells(path, line, row, columns)) for line, row in found[1:])
    )


def _cells(path: Path, line: int, row: list[str], columns: tuple[str, ...]) -> tuple[str, ...]:
    if any(row[len(columns) :]):
        raise CourseError(
            f"{shown(path)}:{line}: has {len(row)} cells and the heading {len(columns)}; "
            "a name with a comma in it belongs into quotes"
        )
    return tuple((row + [""] * len(columns))[: len(columns)])
