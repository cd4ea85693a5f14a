"""`course bundle`: the autograder as other systems take it."""

from __future__ import annotations

from pathlib import Path

import click

from course.cli.options import modules_from
from course.cli.outputs import check_outputs
from course.cli.tables import count
from course.effects import COURSE, PROJECT
from course.errors import CourseError


@click.command()
@click.argument("system", type=click.Choice(["gradescope"]))
@click.option(
    "--out",
    type=click.Path(path_type=Path, dir_okay=False),
    required=True,
    help="The .zip file to upload.",
)
@click.option(
    "--seed",
    type=click.IntRange(0),
    default=0,
    help="Chooses the parameters of scenes and checks; students needn't know it.",
)
@click.option(
    "--modules",
    multiple=True,
    callback=modules_from,
    metavar="MODULE[,MODULE]...",
    help="Grade only these.",
)
def bundle(system: str, out: Path, seed: int, modules: tuple[str, ...]) -> None:
    """Write the autograder with solutions and checks as one archive. It is not for students."""
    from course.grading.classes.bundle import write_gradescope_bundle

    if out.suffix.lower() != ".zip":
        raise click.BadParameter(f"{out} doesn't end in .zip", param_hint="--out")
    if not (PROJECT / "solutions").is_dir():
        raise CourseError("an autograder needs the solutions, and this copy has none")
    # Before references are made, which takes a while.
    check_outputs(files=[("--out", out)])
    files = write_gradescope_bundle(PROJECT, out, seed, modules or tuple(COURSE))
    click.echo(f"{out}: {count(files, 'file')} for {system}, solutions included: not for students")
