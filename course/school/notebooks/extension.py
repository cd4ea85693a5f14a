"""The course in a notebook: ``%load_ext course`` gives ``%%check``, ``%course`` and ``mine``.

What is checked is run in a process of its own, as by `course check`: a function that never ends, or that ends its
process, does so there, and an interrupt leaves the notebook's own process alive.
"""

import shlex
import subprocess
import sys
import warnings
from typing import Any, TextIO

import click
from IPython.core.error import UsageError
from IPython.core.magic_arguments import MagicArgumentParser

from course.base.errors import CourseWarning
from course.base.progress import quiet
from course.engine.functions.modules import COURSE, meant
from course.school.grading.catalog import meant_check
from course.school.grading.checks.check import Check
from course.school.grading.grading import grade
from course.school.grading.places import moved
from course.school.grading.references import has_references, references
from course.school.grading.report import USUAL_SEED
from course.school.grading.reports.printing import Printer, order_in
from course.school.grading.worker.sandbox import plain
from course.school.notebooks.session import MODULE_OF, Mine, Session, bound_in, functions_in

HINTS = ("1", "2", "3")


_PARSER: Any = MagicArgumentParser(prog="%check", add_help=False)  # type: ignore[no-untyped-call]
_PARSER.add_argument("module", nargs="?")
_PARSER.add_argument("--only", metavar="FUNCTION[/CHECK]")
_PARSER.add_argument("--hint", choices=HINTS, default="1")


class Magics:
    """The course's magics.

    Parameters
    ----------
    shell : of IPython
    session : what the notebook holds
    """

    def __init__(self, shell: Any, session: Session) -> None:
        self.shell, self.session = shell, session

    def check(self, line: str, cell: str | None = None) -> None:
        """Check the functions of a cell, or of a module that cells have defined.

        %%check [MODULE] [--only FUNCTION[/CHECK]] [--hint 1|2|3]

        Over a cell it runs the cell first. What it tells is what `course check` tells in a terminal; --hint says how
        much to be told of what is wrong.
        """
        asked = _PARSER.parse_args(shlex.split(line))
        module, only = asked.module, asked.only
        if module is not None and module not in COURSE:
            near = meant(module, COURSE)
            raise UsageError(
                f"%check {module}: no such module"
                + (f"; did you mean {near}?" if near else f"; the modules are {', '.join(COURSE)}")
            )
        defined = frozenset[str]()
        if cell is not None:
            if not self._run(cell):
                return
            defined = functions_in(cell)
        modules = [module] if module else sorted({MODULE_OF[name] for name in defined}, key=_order)
        if not modules:
            raise UsageError("%check: names no module, and the cell defines no function of one")
        if cell is not None:
            _tell_of_slips(cell, defined, modules)
        try:
            for one in modules:
                own = defined & {*COURSE[one]} if cell is not None else {*COURSE[one]}
                self._check(one, own, only, int(asked.hint))
        except KeyboardInterrupt:
            click.echo("interrupted")

    def _run(self, cell: str) -> bool:
        """Run what stands below the magic, with its number and lines as the notebook shows them."""
        before, number = self.shell.execution_count, self.session.number
        self.shell.execution_count = number or before
        try:
            # IPython cuts blank lines off the top; what is below another magic can't have a line above it.
            top = "" if cell.lstrip().startswith("%%") else "#\n"
            return bool(self.shell.run_cell(f"{top}{cell}").success)
        finally:
            self.shell.execution_count = before

    def _check(
        self, module: str, functions: frozenset[str] | set[str], only: str | None, rungs: int
    ) -> None:
        found = self.session.module(module)
        if not functions or not found.text:
            names = ", ".join(COURSE[module])
            click.echo(f"no function of {module} is defined here; they are {names}")
            return
        if found.lacking:
            click.echo(
                f"no cell that was run defines {', '.join(found.lacking)}: run the cells above first"
            )
        for name, cells in found.rebound:
            listed = ", ".join(f"In[{cell}]" for cell in cells[:-1])
            click.echo(
                f"cell In[{cells[-1]}] binds {name}, as {listed} did before: it was run last and counts here; in the "
                "saved notebook, which is graded, the lowest of these cells counts: keep one of them"
            )
        printer = Printer(
            lambda _module, _function: "",
            None,
            rungs,
            "%check",
            slips=lambda result: order_in(found.text, result),
        )
        with quiet():
            report = grade(
                {module: found.text},
                references(USUAL_SEED),
                modules=(module,),
                only=_chosen(functions, only),
                each=lambda result: printer.result(moved(result, found.place, "this notebook")),
                # One's own code needs no walls, and starts sooner without.
                shut_in=plain(),
            )
        if report.results:
            printer.end(report)
        else:
            near = meant_check(only or "", [module])
            click.echo(f"--only {only}: no check of these functions has that name{near}")

    def course(self, line: str) -> None:
        """Run a command of the course, as in a terminal: `%course status`."""
        command = [sys.executable, "-m", "course", *shlex.split(line)]
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, encoding="utf-8"
        ) as process:
            try:
                for row in process.stdout or ():
                    click.echo(row.rstrip("\n"))
            except KeyboardInterrupt:
                process.terminate()
                click.echo("interrupted")


def _tell_of_slips(cell: str, defined: frozenset[str], modules: list[str]) -> None:
    """Say which function of the modules may be meant by a name of the cell that isn't one."""
    others = [name for one in modules for name in COURSE[one] if name not in defined]
    for name in sorted(bound_in(cell) - defined):
        if near := meant(name, others):
            click.echo(f"{name} is no function of {', '.join(modules)}; did you mean {near}?")


def _order(module: str) -> int:
    return [*COURSE].index(module)


def _chosen(functions: Any, only: str | None) -> Any:
    asked, _, name = (only or "").partition("/")
    known = has_references(USUAL_SEED)

    def chosen(check: Check) -> bool:
        if check.prepare is not None and not known:
            return False
        return (
            check.function in functions
            and asked in ("", check.function)
            and name in ("", check.name)
        )

    return chosen


def load(shell: Any) -> None:
    """Add the magics and `mine` to a shell."""
    unload(shell)
    session = Session(shell)
    magics = Magics(shell, session)
    shell.register_magic_function(magics.check, "line_cell", "check")
    shell.register_magic_function(magics.course, "line", "course")
    shell.push({"mine": Mine(shell.user_ns)}, interactive=False)
    _LOADED[id(shell)] = session, warnings.showwarning
    warnings.showwarning = _told


def unload(shell: Any) -> None:
    """Take them away."""
    if id(shell) in _LOADED:
        session, warnings.showwarning = _LOADED.pop(id(shell))
        session.close()


_LOADED: dict[int, tuple[Session, Any]] = {}


def _told(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Print what is doubtful in a line; other warnings look as they always do."""
    text = warnings.formatwarning(message, category, filename, lineno, line)
    ours = issubclass(category, CourseWarning)
    click.echo(f"warning: {message}" if ours else text.rstrip(), file=file, err=True)
