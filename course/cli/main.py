"""The command `course`: its subcommands, and what becomes of errors.

Exit codes: 0 done, 1 refused (a mistake in the input, told in one message), 2 wrong usage,
3 a check that found something wrong, 130 interrupted by Ctrl-C. `compare` has those of `diff`: 0, 1 different, 2.
"""

import atexit
import errno
import gc
import os
import sys
import threading
import warnings
from contextlib import suppress
from importlib import import_module
from io import TextIOWrapper
from pathlib import Path
from typing import TextIO

import click

from course.base.errors import CourseError, CourseWarning
from course.base.processes import READ_THERE, stay_apart
from course.base.texts import clean
from course.base.version import __version__
from course.cli.options import INTERRUPTED
from course.engine.functions.effects import CHECKOUT

SECTIONS = {
    "Learn": ("start", "check", "status", "studio", "portfolio", "docs"),
    "Render": (
        *("render", "pixel", "view", "radiosity", "info", "convert", "compare", "schema"),
        *("demo", "bench"),
    ),
    "Teach": (
        *("release", "grade", "regrade", "viva", "quiz", "bundle", "calibrate", "references"),
    ),
}
"""The commands as `course --help` lists them."""

COMMANDS = tuple(name for names in SECTIONS.values() for name in names)
"""Each is the command of that name in the module of that name beside this file."""


class Refusal(click.ClickException):
    """A mistake in the input: one message on stderr, no traceback."""

    exit_code = 1

    def show(self, file: object = None) -> None:
        """Print the message as compilers do."""
        click.echo(f"error: {clean(self.message)}", err=True)


class Commands(click.Group):
    """Subcommands imported when they are called, and the one place where errors are caught."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order in which they are listed."""
        return list(COMMANDS)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands by what they are for."""
        width = max(map(len, COMMANDS))
        for title, names in SECTIONS.items():
            commands = [(name, self.get_command(ctx, name)) for name in names]
            rows = [
                (name.ljust(width), one.get_short_help_str(1000)) for name, one in commands if one
            ]
            with formatter.section(title):
                formatter.write_dl(rows)

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """Import the command of that name."""
        if name not in COMMANDS:
            return None
        command = getattr(import_module(f"course.cli.{name}"), name)
        assert isinstance(command, click.Command)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command; where there is none of that name, tell which may be meant."""
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            from course.engine.functions.modules import meant

            if not (near := meant(args[0], COMMANDS)):
                raise
            raise click.UsageError(f"{error.message} Did you mean {near}?", ctx) from None

    def invoke(self, ctx: click.Context) -> object:
        """Run a command; what the user can mend becomes a message, anything else is a defect."""
        try:
            Path.cwd()
        except OSError:
            raise Refusal(
                "the current folder is gone or can't be read: go to another one"
            ) from None
        for name, library in READ_THERE.items():
            if Path(name).exists():
                raise Refusal(
                    f"{name}: {library} would obey this file of the current folder: rename it, or go to another folder"
                )
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("always", CourseWarning)
                warnings.showwarning = _told
                return super().invoke(ctx)
        except click.UsageError as error:
            extra = "extra argument" in error.message and error.ctx
            if not (extra and any("--modules" in one.opts for one in extra.command.params)):
                raise
            told = f"{error.message}. Modules are given by --modules."
            raise click.UsageError(told, error.ctx) from None
        except (CourseError, NotImplementedError) as error:
            raise Refusal(str(error)) from error
        except OSError as error:
            # Who reads no further wants no more; click ends in silence then.
            if error.errno in (None, errno.EPIPE):
                raise
            # Of folders and outputs; whatever is read tells of such a name by itself.
            if error.errno == errno.ENAMETOOLONG:
                told = f"a name is too long for a file: {str(error.filename)[:80]}..."
            else:
                named = f"{error.filename}: " if error.filename else ""
                told = f"{named}{str(error.strerror).lower()}"
            raise Refusal(told) from error
        except MemoryError as error:
            raise Refusal(f"not enough memory: {error}".removesuffix(": ")) from error
        except KeyboardInterrupt:
            click.echo("interrupted", err=True)
            raise click.exceptions.Exit(INTERRUPTED) from None


def _told(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Print what is doubtful in the input in a line; other warnings look as they always do."""
    ours = issubclass(category, CourseWarning)
    text = warnings.formatwarning(message, category, filename, lineno, line)
    click.echo(clean(f"warning: {message}") if ours else text.rstrip(), file=file, err=True)


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    help="Penumbra: a course in distribution ray tracing. Begin with `course "
    + ("check sampling" if CHECKOUT else "start FOLDER")
    + "`.",
)
@click.version_option(__version__, prog_name="course")
def commands() -> None:
    """Hold the subcommands; it does nothing itself."""


def main() -> None:
    """Run the command line of this process."""
    stay_apart()
    _open_closed_streams()
    if isinstance(sys.stdout, TextIOWrapper):
        # A title in Greek must not end a render on a console that can't show it.
        sys.stdout.reconfigure(errors="replace")
    # Modules, and what Numba reads, are a hundred thousand objects that stay: Python's collector of garbage looked 300
    # times among them, for a twelfth of a small render's time.
    gc.set_threshold(20_000, 20, 20)
    try:
        commands(prog_name="course")
    except SystemExit as ended:
        _leave(ended.code or 0)
        raise


def _open_closed_streams() -> None:
    """Read from and write to nowhere where the shell has closed a stream: another file would get its number."""
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            nowhere = os.open(os.devnull, os.O_RDWR)
            os.set_inheritable(nowhere, True)
            setattr(sys, name, os.fdopen(nowhere, "r" if name == "stdin" else "w"))


def _leave(code: str | int) -> None:
    """End this process without taking all of its modules apart, which takes a fifth of a second once Numba is there."""
    others = (each for each in threading.enumerate() if each is not threading.current_thread())
    if isinstance(code, int) and all(each.daemon for each in others):
        # What is closed at the end of a program is closed; memory is given back by the system.
        atexit._run_exitfuncs()
        with suppress(OSError):
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
