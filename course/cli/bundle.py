"""`course bundle`: the autograder as other systems take it."""

from __future__ import annotations

from pathlib import Path

import click

from course.cli.classes import trust_option
from course.cli.options import modules_from
from course.cli.outputs import check_outputs
from course.cli.tables import count, print_sections
from course.effects import COURSE, PROJECT
from course.errors import CourseError


@click.command()
@click.argument("system", type=click.Choice(["gradescope", "prairielearn", "docker"]))
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    required=True,
    help="For Gradescope the .zip file to upload, else a folder that is new or empty.",
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
@click.option("--title", default="", help="Of the question, for PrairieLearn.")
@click.option("--image", help="Its name with the registry, for PrairieLearn.")
@trust_option
def bundle(
    system: str,
    out: Path,
    seed: int,
    modules: tuple[str, ...],
    title: str,
    image: str | None,
    trusted: bool,
) -> None:
    """Write the autograder with solutions and checks, for a system that runs it. It is not for students.

    gradescope: the archive to upload. prairielearn: a question, and in it the folder of its grader's image.
    docker: the folder of an image that grades a class or one submission.
    """
    if not (PROJECT / "solutions").is_dir():
        raise CourseError("an autograder needs the solutions, and this copy has none")
    if system != "prairielearn" and (title or image):
        raise click.UsageError("--title and --image are for prairielearn")
    modules = modules or tuple(COURSE)
    if system == "gradescope":
        files = _gradescope(out, seed, modules, trusted)
    else:
        files = _folder(system, out, seed, modules, title, image, trusted)
    click.echo(f"{out}: {count(files, 'file')} for {system}, solutions included: not for students")
    _tell_totals(modules)


def _gradescope(out: Path, seed: int, modules: tuple[str, ...], trusted: bool) -> int:
    from course.grading.classes.bundle import write_gradescope_bundle

    if out.suffix.lower() != ".zip":
        raise click.BadParameter(f"{out} doesn't end in .zip", param_hint="--out")
    # Before references are made, which takes a while.
    check_outputs(files=[("--out", out)])
    return write_gradescope_bundle(PROJECT, out, seed, modules, trusted=trusted)


def _folder(
    system: str,
    out: Path,
    seed: int,
    modules: tuple[str, ...],
    title: str,
    image: str | None,
    trusted: bool,
) -> int:
    from course.grading.classes.image import IMAGE, check_folder, image_contents, write_folder
    from course.grading.classes.prairielearn_bundle import LONGEST, question_contents

    check_folder(out)
    if system == "docker":
        contents = image_contents(PROJECT, seed, modules, LONGEST, trusted=trusted)
    else:
        contents = question_contents(PROJECT, seed, modules, title, image or IMAGE, trusted=trusted)
    return write_folder(contents, out)


def _tell_totals(modules: tuple[str, ...]) -> None:
    from course.grading.classes.totals import totals

    points = totals(modules)
    rows = [(module, f"{of:g}") for module, of in points.items()]
    rows.append(("in all", f"{sum(points.values()):g}"))
    print_sections("Points to earn", [("", rows)])
