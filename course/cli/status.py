"""`course status`: how far one is, and what comes next."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.cli.options import folder_option, modules_argument
from course.engine.functions.modules import COURSE, TAUGHT

if TYPE_CHECKING:
    from course.school.grading.progress import FunctionProgress


@click.command()
@modules_argument
@folder_option
@click.option("--json", "as_json", is_flag=True, help="Print every function as JSON, for programs.")
def status(modules: tuple[str, ...], folder: Path, as_json: bool) -> None:
    """Show which modules are done, the points, and what comes next.

    Files that have changed since they were checked last are checked; what was found is kept in
    the folder, in .course/checked.json.
    """
    from course.engine.functions.sources import told_place
    from course.school.grading.progress import as_data, next_one, progress

    def before(module: str) -> None:
        if not as_json:
            click.echo(f"checking {module}", err=True)

    made = progress(folder, modules, before, together=True)
    of = {functions[0].module: functions for functions in made if functions}
    # The picture of all modules together is of none of them.
    found = [of[module] for module in (*TAUGHT, *of.keys() - TAUGHT.keys()) if module in of]
    every = [function for functions in found for function in functions]
    coming = next_one(every)
    if as_json:
        document = {
            "points": sum(one.points for one in every),
            "of": sum(one.of for one in every),
            "functions": as_data(every),
            "next": None if coming is None else as_data([coming])[0],
        }
        click.echo(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False))
        return
    rows = [_row(functions) for functions in found]
    if sys.stdout.isatty():
        _print_rich(rows)
    else:
        wide = max((len(row[0]) for row in rows), default=0)
        for name, state, count, points in rows:
            click.echo(f"{name:<{wide}}  {state:<10}  {count:<9}  {points}")
    click.echo(f"\n{_total(every)}")
    if coming is None:
        click.echo("next: nothing; every function is right")
        return
    click.echo(f"next: {coming.module}.{coming.name}, {_state(coming)}")
    if coming.module in TAUGHT:
        click.echo(f"  write  {told_place(_near(coming.file), (coming.cell, coming.line))}")
    click.echo(f"  read   {coming.page}")
    module = f"{coming.module} " if coming.module in TAUGHT else ""
    click.echo(f"  check  course check {module}--only {coming.name}")


def _near(file: str) -> str:
    """A file as it is called from here, where it lies below."""
    path = Path(file).resolve()
    here = Path.cwd()
    return str(path.relative_to(here) if path.is_relative_to(here) else path)


def _state(function: FunctionProgress) -> str:
    return f"{function.state}: {function.title}" if function.title else function.state


def _row(functions: list[FunctionProgress]) -> tuple[str, str, str, str]:
    right = sum(one.state == "right" for one in functions)
    begun = any(one.state != "to do" for one in functions)
    wrong = sum(one.state == "wrong" for one in functions)
    state = (
        "done"
        if right == len(functions)
        else f"{wrong} wrong"
        if wrong
        else "begun"
        if begun
        else "to do"
    )
    module = functions[0].module
    name = module if module in COURSE else "all together"
    return name, state, f"{right} of {len(functions)}", _points(functions)


def _points(functions: list[FunctionProgress]) -> str:
    from course.school.grading.report import as_points

    return f"{as_points(sum(o.points for o in functions))} of {as_points(sum(o.of for o in functions))}"


def _total(functions: list[FunctionProgress]) -> str:
    own = [one for one in functions if one.module in COURSE]
    right = sum(one.state == "right" for one in own)
    return f"{right} of {len(own)} functions are right, {_points(functions)} points"


def _print_rich(rows: list[tuple[str, str, str, str]]) -> None:
    from rich.box import HORIZONTALS
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    styles = {"done": "green", "to do": "dim", "begun": "yellow"}
    table = Table(box=HORIZONTALS, border_style="dim")
    for name, justify in (
        ("module", "left"),
        ("state", "left"),
        ("right", "right"),
        ("points", "right"),
    ):
        table.add_column(name, justify=justify, no_wrap=True)  # type: ignore[arg-type]
    for name, state, count, points in rows:
        table.add_row(Text(name), Text(state, style=styles.get(state, "red")), count, points)
    Console().print(table)
