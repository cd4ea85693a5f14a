"""Results of checks as they come in, for a terminal and below the cells of a notebook."""

import ast
from collections.abc import Callable
from pathlib import Path

import click

from course.base.texts import count
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reachable import parsed
from course.engine.functions.sources import named, place_in, program_of, told_place
from course.school.grading.checks.declare import declaration
from course.school.grading.checks.result import Result
from course.school.grading.places import told_of
from course.school.grading.report import (
    FunctionResults,
    Report,
    as_points,
    docs_page,
    ending,
    findings,
    reproduce,
    unstarted,
)

SHORT = 100
"""Characters of what several checks have found, where it has been told in full before."""

FEW_POINTS = (
    "Of a function's 10 points its core has 8, its corners 1.5, the conventions, which most stubs keep, 0.5: few points"
    " for many checks mean that the core is wrong."
)
"""Told where checks and points say different things."""


class Printer:
    """Prints results as they come: a line for each function, and what went wrong under it.

    Parameters
    ----------
    place : where a function of a module is, as a message has it; empty where that needn't be told
    seed : of the checks
    rungs : of the ladder of hints
    command : that checks
    loops : what is told of a function that gave no answer in time: where its loops are
    slips : what is told of a function whose text says what is wrong, before all else
    """

    def __init__(
        self,
        place: Callable[[str, str], str],
        seed: int | None,
        rungs: int,
        command: str = "course check",
        loops: Callable[[Result], str] = lambda _: "",
        slips: Callable[[Result], str] = lambda _: "",
    ) -> None:
        self._place, self._seed, self._rungs = place, seed, rungs
        self._command, self._loops, self._slips = command, loops, slips
        self._module = ""
        self._pending: list[Result] = []

    def result(self, result: Result) -> None:
        """Take a result in; those of a function are printed together."""
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
        """Print what is left, what the code has printed, and the points."""
        self._flush()
        for module, text in report.printed.items():
            click.echo(f"\n{module} printed:")
            click.echo("\n".join(f"  | {line}" for line in text.splitlines()[:12]))
        passed = sum(result.status == "passed" for result in report.results)
        click.secho(
            f"\n{as_points(report.points)} of {as_points(report.of)} points, "
            f"{passed} of {count(len(report.results), 'check')} passed, {report.seconds:.1f} s",
            bold=True,
        )
        if 2 * passed > len(report.results) and 2 * report.points < report.of:
            click.echo(FEW_POINTS)

    def _flush(self) -> None:
        results, self._pending = self._pending, []
        if not results:
            return
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
                if place := self._place(results[0].module, function):
                    _line("write", place)
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
            click.echo(f"      {count(len(repeated), 'check')} more: {short(found)}")
            _line("these", names)

    def _tell(self, result: Result) -> None:
        what = "" if ending(result) == "failed" else f" [{ending(result)}]"
        click.echo(f"      {click.style(result.check, bold=True)}{what}: {result.title}")
        slip = self._slips(result)
        for label, text in findings(result, self._rungs):
            if slip and label == "hint":
                continue
            _line(label, click.style(text, fg="cyan") if label == "looks like" else text)
        if slip:
            _line("hint", slip)
        below = len(findings(result)) > len(findings(result, self._rungs))
        more = f" --hint {self._rungs + 1}" if below else ""
        again = reproduce(result, self._seed).replace("course check", self._command, 1)
        _line("more" if below else "again", f"{again}{more}")
        if place := self._place(result.module, result.function):
            _line("file", f"{place}{self._loops(result)}")
        _line("read", docs_page(result))


def loops_in(path: Path, result: Result) -> str:
    """Of a function that gave no answer in time, its loops that may never end."""
    if result.status != "timeout":
        return ""
    tree = ast.parse(program_of(path, result.module))
    lines = [
        str(place_in(path, result.module, loop.lineno)[1])
        for function in tree.body
        if isinstance(function, ast.FunctionDef) and function.name == result.function
        for loop in ast.walk(function)
        if isinstance(loop, ast.While)
    ]
    return f", with a loop by `while` in line {', '.join(lines)}" if lines else ""


def order_in(source: bytes, result: Result) -> str:
    """Of a function whose arguments stand in another order than the stub's, both; empty for any other."""
    declared = declaration(result.module, result.function) if result.module in COURSE else None
    tree = parsed(source)
    if declared is None or tree is None:
        return ""
    wanted = [argument.name for argument in declared.arguments]
    named = [
        [argument.arg for argument in (*node.args.posonlyargs, *node.args.args)]
        for node in tree.body
        if isinstance(node, ast.FunctionDef) and node.name == result.function
    ]
    own = named[-1] if named else []
    if all(name not in wanted or wanted.index(name) == place for place, name in enumerate(own)):
        return ""
    return (
        f"Arguments come in the order of the stub, {result.function}({', '.join(wanted)}); yours are "
        f"({', '.join(own)})."
    )


def place_told(files: dict[str, Path], folder: Path, module: str, function: str) -> str:
    """Where a function of one's own is, as a message has it."""
    path = files.get(module)
    return (
        told_place(named(folder, module), (0, 1))
        if path is None
        else told_of(path, module, function)
    )


def short(text: str) -> str:
    """What was found, in a line."""
    line = " ".join(text.split())
    return line if len(line) <= SHORT else f"{line[:SHORT]} ..."


def _line(label: str, text: str) -> None:
    first, *rest = text.rstrip().splitlines() or [""]
    click.echo(f"        {label:<10}  {first}")
    for line in rest[-8:]:
        click.echo(f"        {'':<10}  {line}")
