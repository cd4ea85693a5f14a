"""`course bundle`: the autograder as other systems take it."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import click

from course.base.errors import CourseError
from course.base.texts import count
from course.cli.classes import trust_option
from course.cli.options import PATH, choice_options
from course.cli.outputs import check_outputs
from course.cli.tables import print_sections
from course.engine.functions.effects import PROJECT


@click.command()
@click.argument("system", type=click.Choice(["gradescope", "prairielearn", "docker"]))
@click.option(
    "--out",
    type=PATH,
    required=True,
    help="For Gradescope the .zip file to upload, else a folder that is new or empty.",
)
@choice_options
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
    write = _archive if system == "gradescope" else _folder
    files = write(out, partial(_contents, system, seed, modules, title, image, trusted))
    click.echo(f"{out}: {count(files, 'file')} for {system}, solutions included: not for students")
    _tell_totals(modules)


def _contents(
    system: str, seed: int, modules: tuple[str, ...], title: str, image: str | None, trusted: bool
) -> dict[str, bytes]:
    """Path in the archive or folder -> content."""
    from course.school.grading.classes import bundles

    if system == "gradescope":
        return bundles.gradescope_contents(PROJECT, seed, modules, trusted=trusted)
    if system == "docker":
        return bundles.image_contents(PROJECT, seed, modules, bundles.LONGEST, trusted=trusted)
    return bundles.question_contents(
        PROJECT, seed, modules, title, image or bundles.IMAGE, trusted=trusted
    )


# Both look at the place before the contents are made, which takes a while.


def _archive(out: Path, contents: Callable[[], dict[str, bytes]]) -> int:
    from course.school.grading.release.archive import write_zip

    if out.suffix.lower() != ".zip":
        raise click.BadParameter(f"{out} doesn't end in .zip", param_hint="--out")
    check_outputs(files=[("--out", out)])
    return write_zip(contents(), out)


def _folder(out: Path, contents: Callable[[], dict[str, bytes]]) -> int:
    from course.school.grading.release.archive import check_folder, write_folder

    check_folder(out)
    return write_folder(contents(), out)


def _tell_totals(modules: tuple[str, ...]) -> None:
    from course.school.grading.classes.bundles import totals

    points = totals(modules)
    rows = [(module, f"{of:g}") for module, of in points.items()]
    rows.append(("in all", f"{sum(points.values()):g}"))
    print_sections("Points to earn", [("", rows)])
