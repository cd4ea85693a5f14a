"""Tables of named values in sections: rich's on a terminal, aligned plain text elsewhere."""

import sys
from collections.abc import Iterable, Mapping, Sequence

import click

from course.engine.render.sections import Section, plain_text


def print_sections(title: str, sections: Iterable[Section]) -> None:
    """Print a table on stdout."""
    sections = list(sections)
    if sys.stdout.isatty():
        _print_rich(title, sections)
    else:
        click.echo(plain_text(title, sections))


def _print_rich(title: str, sections: Sequence[Section]) -> None:
    from rich.box import HORIZONTALS
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    # Text, not str: what stands in square brackets in a file's name is no markup.
    table = Table(box=HORIZONTALS, show_header=False, title_justify="left", border_style="dim")
    table.title = Text(title, style="bold")
    table.add_column(style="cyan", no_wrap=True)
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for heading, rows in sections:
        for number, (label, value) in enumerate(rows):
            first = heading if number == 0 else ""
            last = number == len(rows) - 1
            table.add_row(Text(first), Text(label), Text(value), end_section=last)
    Console().print(table)


def summary_sections(summary: Mapping[str, Mapping[str, object]]) -> list[Section]:
    """Arrange what a scene says of itself.

    ``summary``: sections by heading, each a mapping of labels to values, as a scene's `summary` gives it.
    Sections without a row are left out.
    """
    return [
        (heading, [(label, _text(value)) for label, value in rows.items()])
        for heading, rows in summary.items()
        if rows
    ]


def _text(value: object) -> str:
    return f"{value:,}" if isinstance(value, int) else str(value)
