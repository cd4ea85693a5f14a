"""`course check`: what a student runs while working."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.atomic import write_text
from course.base.errors import CourseError
from course.cli.options import FAILED, OUT_FILE, folder_option, modules_argument
from course.cli.outputs import check_outputs
from course.cli.watching import await_change, times
from course.engine.functions.notebook.reading import UNNEEDED
from course.engine.functions.sources import cells_of, find_module, is_notebook, named, told_place

if TYPE_CHECKING:
    from course.engine.functions.notebook.needed import Place
    from course.school.grading.checks.check import Check, References
    from course.school.grading.checks.result import Result
    from course.school.grading.report import Report


@click.command()
@modules_argument
@folder_option
@click.option(
    "--only", metavar="FUNCTION[/CHECK]", help="Run only this function's checks, or this one check."
)
@click.option(
    "--seed", type=click.IntRange(0), default=0, help="Chooses the parameters of scenes and checks."
)
@click.option(
    "--hint",
    "rungs",
    type=click.IntRange(1, 3),
    default=1,
    show_default=True,
    help="How much to be told of what is wrong: 1 which law is broken, 2 also the smallest input that breaks it, "
    "3 also which known mistake it looks like. Never the code.",
)
@click.option(
    "--lines",
    is_flag=True,
    help="Print a line for each function that isn't right, as compilers do: FILE:LINE: MESSAGE. Editors read it.",
)
@click.option("--watch", is_flag=True, help="Check again whenever a file is saved, until Ctrl-C.")
@click.option("--html", type=OUT_FILE, help="Write a page with pictures and plots.")
@click.option("--json", "json_file", type=OUT_FILE, help="Write the results.")
@click.pass_context
def check(
    ctx: click.Context,
    modules: tuple[str, ...],
    folder: Path,
    only: str | None,
    seed: int,
    rungs: int,
    lines: bool,
    watch: bool,
    html: Path | None,
    json_file: Path | None,
) -> None:
    """Check your functions: all of them, or those of some modules.

    Each function is checked by itself. The exit code is 0 when everything is right.
    """
    from course.school.grading.references import references
    from course.school.grading.submissions import find_modules

    check_outputs(files=[("--html", html), ("--json", json_file)])
    arrays = references(seed)

    def files() -> list[Path]:
        return [find_module(folder, module) or named(folder, module) for module in modules]

    while True:
        seen = times(files())
        report = _check(folder, modules, only, seed, arrays, rungs)
        if lines:
            _print_lines(report, find_modules(folder, modules), folder)
        if html is not None:
            from course.school.grading.reports.page import as_page

            write_text(html, as_page(report))
            click.echo(f"{html} written")
        if json_file is not None:
            from course.school.grading.reports.formats import as_json

            document = as_json(report)
            text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
            write_text(json_file, f"{text}\n")
            click.echo(f"{json_file} written")
        if not watch:
            ctx.exit(0 if report.points == report.of and not report.broken else FAILED)
        await_change(files, seen)


def _check(
    folder: Path,
    modules: tuple[str, ...],
    only: str | None,
    seed: int,
    arrays: References,
    rungs: int,
) -> Report:
    from course.school.grading.catalog import meant_check
    from course.school.grading.grading import grade
    from course.school.grading.references import has_references
    from course.school.grading.reports.printing import Printer, loops_in, order_in, place_told
    from course.school.grading.submissions import find_modules, read_found
    from course.school.grading.worker.sandbox import plain

    paths = find_modules(folder, modules)
    for path in paths.values():
        if path.parent != folder and path != folder:
            click.echo(f"{folder / path.name} is missing; {path} is checked in its place", err=True)
    for said in dict.fromkeys(
        f"{path}: {told}"
        for module, path in paths.items()
        if is_notebook(path)
        for told in cells_of(path, module).told
        if not told.startswith(UNNEEDED)
    ):
        click.echo(said, err=True)
    chosen = _chooser(only)
    if not has_references(seed):
        chosen = _without_references(chosen, seed)
    shown = Printer(
        partial(place_told, paths, folder),
        seed,
        rungs,
        loops=lambda result: (
            loops_in(paths[result.module], result) if result.module in paths else ""
        ),
        slips=lambda result: order_in(sources.get(result.module, b""), result),
    )
    sources = read_found(folder, paths)
    report = grade(
        sources,
        arrays,
        seed=seed,
        modules=modules,
        only=chosen,
        each=shown.result,
        # One's own code needs no walls, and starts sooner without.
        shut_in=plain(),
        folder=folder,
        files=paths,
    )
    if not report.results:
        if not has_references(seed):
            raise CourseError(
                f"only checks that compare with references are asked for: leave --seed {seed} out"
            )
        raise CourseError(
            f"--only {only}: no check of {', '.join(modules)} has that name{meant_check(only or '', modules)}"
        )
    shown.end(report)
    return report


def _print_lines(report: Report, paths: dict[str, Path], folder: Path) -> None:
    """A line for each function that isn't right, the first thing that was found of it."""
    from course.school.grading.places import place_of
    from course.school.grading.report import grouped
    from course.school.grading.reports.printing import short

    click.echo()
    for module in grouped(report):
        path = paths.get(module.name, named(folder, module.name))
        if module.trouble and module.functions[0].state != "to do":
            place = _stopped(path, module.name, module.trouble) or (0, 1)
            click.echo(f"{told_place(path, place)}: error: {short(module.trouble.found)}")
            continue
        for function in module.functions:
            if function.state == "right":
                continue
            severity = "warning" if function.state == "to do" else "error"
            told = function.told[:1] if severity == "error" else ()
            text = "".join(f"{one.title}: {short(one.found)}" for one in told)
            stopped = _stopped(path, module.name, told[0]) if told else None
            place = stopped or place_of(path, module.name, function.name)
            what = f"{severity}: {function.name}: {text or function.state}"
            click.echo(f"{told_place(path, place)}: {what}")


def _stopped(path: Path, module: str, result: Result) -> Place | None:
    """Where Python has stopped: the last line of its traceback that is of the module's file; None if there is none."""
    file = path.name if is_notebook(path) else f"{module}.py"
    lines = re.findall(
        rf"^ *File \"{re.escape(file)}\",(?: cell (\d+)[^,]*,)? line (\d+)",
        result.where,
        re.MULTILINE,
    )
    return (int(lines[-1][0] or 0), int(lines[-1][1])) if lines else None


def _chooser(only: str | None) -> Callable[[Check], bool] | None:
    if only is None:
        return None
    function, _, name = only.partition("/")
    return lambda check: check.function == function and name in ("", check.name)


def _without_references(
    chosen: Callable[[Check], bool] | None, seed: int
) -> Callable[[Check], bool]:
    """Only checks that need no references, which is told."""
    click.echo(
        f"this copy has no references for the seed {seed}: checks that need some, such as those of pictures, "
        "are left out; without --seed they are made",
        err=True,
    )
    return lambda check: check.prepare is None and (chosen is None or chosen(check))
