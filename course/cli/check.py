"""`course check`: what a student runs while working."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.atomic import write_text
from course.base.errors import CourseError
from course.cli.options import FAILED, OUT_FILE, folder_option, modules_argument
from course.cli.outputs import check_outputs
from course.cli.tables import count
from course.cli.watching import await_change, times
from course.engine.functions.modules import meant

if TYPE_CHECKING:
    from course.school.grading.checks.check import Check, References
    from course.school.grading.checks.result import Result
    from course.school.grading.report import Report

SHORT = 100
"""Characters of what several checks have found, where it has been told in full before."""


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

    check_outputs(files=[("--html", html), ("--json", json_file)])
    arrays = references(seed)

    def files() -> list[Path]:
        return [folder / f"{module}.py" for module in modules]

    while True:
        seen = times(files())
        report = _check(folder, modules, only, seed, arrays, rungs)
        if lines:
            _print_lines(report, folder)
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
    from course.school.grading.grading import grade
    from course.school.grading.references import has_references
    from course.school.grading.submissions import find_modules, read_found
    from course.school.grading.worker.sandbox import plain

    paths = find_modules(folder, modules)
    for path in paths.values():
        if path.parent != folder:
            click.echo(f"{folder / path.name} is missing; {path} is checked in its place", err=True)
    chosen = _chooser(only)
    if not has_references(seed):
        chosen = _without_references(chosen, seed)
    shown = _Printer(folder, seed, rungs)
    report = grade(
        read_found(folder, paths),
        arrays,
        seed=seed,
        modules=modules,
        only=chosen,
        each=shown.result,
        # One's own code needs no walls, and starts sooner without.
        shut_in=plain(),
        folder=folder,
    )
    if not report.results:
        if not has_references(seed):
            raise CourseError(
                f"only checks that compare with references are asked for: leave --seed {seed} out"
            )
        raise CourseError(
            f"--only {only}: no check of {', '.join(modules)} has that name{_near(only, modules)}"
        )
    shown.end(report)
    return report


def _near(only: str | None, modules: tuple[str, ...]) -> str:
    """The function or check that may be meant by a name that isn't one; empty where none is alike."""
    from course.school.grading.catalog import module_checks

    checks = [check for module in modules for check in module_checks(module).checks]
    names = {check.function for check in checks}
    function, _, name = (only or "").partition("/")
    if function in names:
        near = meant(name, [check.name for check in checks if check.function == function])
        return f"; did you mean {function}/{near}?" if near else ""
    near = meant(function, names)
    return f"; did you mean {near}?" if near else ""


def _print_lines(report: Report, folder: Path) -> None:
    """A line for each function that isn't right, the first thing that was found of it."""
    from course.school.grading.progress import line_of
    from course.school.grading.report import grouped

    click.echo()
    for module in grouped(report):
        path = folder / f"{module.name}.py"
        if module.trouble and module.functions[0].state != "to do":
            line = _stopped(module.name, module.trouble) or 1
            click.echo(f"{path}:{line}: error: {_short(module.trouble.found)}")
            continue
        for function in module.functions:
            if function.state == "right":
                continue
            severity = "warning" if function.state == "to do" else "error"
            told = function.told[:1] if severity == "error" else ()
            text = "".join(f"{one.title}: {_short(one.found)}" for one in told)
            stopped = _stopped(module.name, told[0]) if told else 0
            line = stopped or line_of(path, function.name)
            click.echo(f"{path}:{line}: {severity}: {function.name}: {text or function.state}")


def _stopped(module: str, result: Result) -> int:
    """Where Python has stopped: the last line of its traceback that is of the module's file; 0 if there is none."""
    lines = re.findall(rf"^ *File \"{module}\.py\", line (\d+)", result.where, re.MULTILINE)
    return int(lines[-1]) if lines else 0


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


class _Printer:
    """Prints results as they come: a line for each function, and what went wrong under it."""

    def __init__(self, folder: Path, seed: int, rungs: int) -> None:
        self._folder, self._seed, self._rungs = folder, seed, rungs
        self._module = ""
        self._pending: list[Result] = []

    def result(self, result: Result) -> None:
        if self._pending and self._pending[0].function != result.function:
            self._flush()
        if result.module != self._module:
            self._flush()
            self._module = result.module
            click.secho(result.module, bold=True)
            if result.module_wide:
                click.secho(f"  {result.found}", fg="red")
                for line in result.where.splitlines():
                    click.echo(f"  {line}")
                if result.hint:
                    click.echo(f"  {result.hint}")
        self._pending.append(result)

    def end(self, report: Report) -> None:
        from course.school.grading.report import as_points

        self._flush()
        for module, text in report.printed.items():
            click.echo(f"\n{module}.py printed:")
            click.echo("\n".join(f"  | {line}" for line in text.splitlines()[:12]))
        passed = sum(result.status == "passed" for result in report.results)
        click.secho(
            f"\n{as_points(report.points)} of {as_points(report.of)} points, "
            f"{passed} of {count(len(report.results), 'check')} passed, {report.seconds:.1f} s",
            bold=True,
        )

    def _flush(self) -> None:
        results, self._pending = self._pending, []
        if not results:
            return
        from course.school.grading.progress import line_of
        from course.school.grading.report import FunctionResults, docs_page, unstarted

        function = results[0].function
        wrong = [result for result in results if result.status != "passed"]
        if not wrong:
            click.echo(
                f"  {click.style('right', fg='green')}    {function}  ({count(len(results), 'check')})"
            )
            for note in dict.fromkeys(result.hint for result in results if result.hint):
                click.echo(f"           {note}")
            return
        if all(result.status == "not attempted" for result in results):
            click.echo(f"  {click.style('to do', fg='yellow')}    {function}")
            if unstarted(results[0]) and not results[0].module_wide:
                click.echo(f"           {unstarted(results[0])}")
            if not results[0].module_wide:
                path = self._folder / f"{results[0].module}.py"
                _line("write", f"{path}:{line_of(path, function)}")
                _line("read", docs_page(results[0]))
            return
        click.echo(
            f"  {click.style('wrong', fg='red')}    {function}  ({len(wrong)} of {count(len(results), 'check')})"
        )
        if results[0].module_wide:
            return
        grouped = FunctionResults(self._module, function, tuple(results))
        for number, result in enumerate(grouped.told):
            # What is found first mostly explains the rest, which is told in full when it is asked for.
            if number:
                _line("also", f"{result.check}: {result.title}")
            else:
                self._tell(result)
        for found, repeated in grouped.repeated:
            names = ", ".join(result.check for result in repeated)
            click.echo(f"      {count(len(repeated), 'check')} more: {_short(found)}")
            _line("these", names)

    def _tell(self, result: Result) -> None:
        from course.school.grading.progress import line_of
        from course.school.grading.report import docs_page, ending, findings, reproduce

        what = "" if ending(result) == "failed" else f" [{ending(result)}]"
        click.echo(f"      {click.style(result.check, bold=True)}{what}: {result.title}")
        for label, text in findings(result, self._rungs):
            _line(label, click.style(text, fg="cyan") if label == "looks like" else text)
        below = len(findings(result)) > len(findings(result, self._rungs))
        more = f" --hint {self._rungs + 1}" if below else ""
        _line("more" if below else "again", f"{reproduce(result, self._seed)}{more}")
        path = self._folder / f"{result.module}.py"
        _line("file", f"{path}:{line_of(path, result.function)}{_loops(path, result)}")
        _line("read", docs_page(result))


def _loops(path: Path, result: Result) -> str:
    """Of a function that gave no answer in time, its loops that may never end."""
    if result.status != "timeout":
        return ""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    lines = [
        str(loop.lineno)
        for function in tree.body
        if isinstance(function, ast.FunctionDef) and function.name == result.function
        for loop in ast.walk(function)
        if isinstance(loop, ast.While)
    ]
    return f", with a loop by `while` in line {', '.join(lines)}" if lines else ""


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= SHORT else f"{line[:SHORT]} ..."


def _line(label: str, text: str) -> None:
    first, *rest = text.rstrip().splitlines() or [""]
    click.echo(f"        {label:<10}  {first}")
    for line in rest[-8:]:
        click.echo(f"        {'':<10}  {line}")
