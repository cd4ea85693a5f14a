"""`course release`: what students get, made from the solutions."""

from __future__ import annotations

from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.atomic import make_folder, write_text
from course.base.errors import OutputError
from course.base.texts import count
from course.cli.options import PATH
from course.cli.outputs import check_outputs
from course.engine.functions.effects import CHECKOUT, PROJECT

if TYPE_CHECKING:
    from course.school.grading.release.stubs import Stub

SOLUTIONS = PROJECT / "solutions"
ASSIGNMENTS = (PROJECT if CHECKOUT else Path()) / "assignments"

SHOWN = 16
"""Lines of a difference that are printed; it is to be recognised, not to be read."""


@click.command()
@click.option("--check", is_flag=True, help="Write nothing; fail if a stub is not up to date.")
@click.option("--force", is_flag=True, help="Write over functions that somebody has written.")
@click.option(
    "--out", type=PATH, help="Write the whole student archive there, a folder or a .zip file."
)
@click.option(
    "--site",
    type=PATH,
    help="Put the built site in, too, which `make docs` makes: the pages with their pictures.",
)
def release(check: bool, force: bool, out: Path | None, site: Path | None) -> None:
    """Make the stubs in assignments/ from solutions/, or with --out all that students get.

    A stub is its solution without what stands between ### BEGIN SOLUTION and ### END SOLUTION.
    """
    from course.school.grading.release.stubs import make_stubs

    if site is not None and out is None:
        raise click.UsageError("--site is put into the archive of --out")
    if out is not None:
        from course.school.grading.release.archive import write_archive

        if out.suffix == ".zip":
            # Before the references are made, which takes a while. A folder is made where there is none.
            check_outputs(files=[("--out", out)])
        click.echo("making the references of all checks, which takes up to a minute", err=True)
        files = write_archive(PROJECT, out, site)
        click.echo(f"{out}: {count(files, 'file')}, searched for solutions and free of them")
        return
    stubs = make_stubs(SOLUTIONS)
    if check:
        _check(stubs)
    else:
        _write(stubs, force)


def _check(stubs: list[Stub]) -> None:
    drifted = [stub for stub in stubs if _found(stub) != stub.text]
    for stub in drifted:
        click.echo(_difference(stub))
    names = [_shown(stub.module) for stub in drifted]
    orphans = _orphans(stubs)
    for name in orphans:
        click.echo(f"{name} has no solution: delete it")
    if names or orphans:
        advice = "; `course release` makes them anew" if names else ""
        raise OutputError(f"not what the solutions make: {', '.join(names + orphans)}{advice}")
    click.echo(f"{count(len(stubs), 'stub')} up to date")


def _write(stubs: list[Stub], force: bool) -> None:
    # All are looked at before any is written.
    for stub in stubs:
        written = stub.written(_found(stub) or "")
        if written and not force:
            raise OutputError(
                f"{_shown(stub.module)} holds work that would be lost: {', '.join(written)}; "
                "move it elsewhere, or say --force"
            )
    make_folder(ASSIGNMENTS)
    for stub in stubs:
        changed = _found(stub) != stub.text
        if changed:
            write_text(_path(stub.module), stub.text)
        click.echo(f"{_shown(stub.module)} {'written' if changed else 'is up to date'}")
    for name in _orphans(stubs):
        click.echo(f"{name} has no solution: delete it", err=True)


def _orphans(stubs: list[Stub]) -> list[str]:
    """Files in assignments/ that no solution makes."""
    modules = {stub.module for stub in stubs}
    return [
        _shown(path.stem)
        for path in sorted(ASSIGNMENTS.glob("*.py"))
        if not path.stem.startswith("_") and path.stem not in modules
    ]


def _found(stub: Stub) -> str | None:
    """Text of the stub that is there; None where there is none."""
    path = _path(stub.module)
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return None
    except OSError as error:
        raise OutputError(f"{path}: can't be read: {error.strerror}") from error


def _difference(stub: Stub) -> str:
    name, found = _shown(stub.module), _found(stub)
    if found is None:
        return f"{name} is missing"
    lines = [
        *unified_diff(
            found.splitlines(), stub.text.splitlines(), name, "expected", n=1, lineterm=""
        )
    ]
    more = len(lines) - SHOWN
    return "\n".join([*lines[:SHOWN], *([f"... and {more} lines more"] if more > 0 else [])])


def _path(module: str) -> Path:
    return ASSIGNMENTS / f"{module}.py"


def _shown(module: str) -> str:
    return f"{ASSIGNMENTS.name}/{module}.py"
