"""`course quiz`: questions about known mistakes, for learning platforms."""

import sys
import tempfile
from contextlib import ExitStack
from importlib import import_module
from pathlib import Path

import click

from course.base.errors import CourseError
from course.base.texts import count
from course.cli.options import OUT_FOLDER, modules_from
from course.engine.functions.effects import CHECKOUT, PROJECT
from course.engine.functions.modules import COURSE

DRAWN_BY = PROJECT / "docs"
"""The folder of the package that draws the site's figures, and those of questions."""


@click.command()
@click.argument("out", type=OUT_FOLDER)
@click.option(
    "--modules",
    multiple=True,
    metavar="MODULE[,...]",
    callback=modules_from,
    help="Only these modules.  [default: all]",
)
@click.option(
    "--held-back",
    is_flag=True,
    help="Only the questions that no page of the site shows with their answers, as for an exam.",
)
def quiz(out: Path, modules: tuple[str, ...], held_back: bool) -> None:
    """Write questions about known mistakes into OUT, a folder that is new or empty. It is not for students.

    OUT gets files for Canvas (QTI 1.2), Moodle, PrairieLearn and whatever else reads QTI 2.1, and a README.md that
    says how to import them. Pictures are drawn now; answers that can't be told apart by measurement are refused.
    """
    from course.school.grading.release.archive import check_folder, write_folder

    if not (PROJECT / "solutions" / "quizzes").is_dir():
        raise CourseError("questions are made from the solutions, and this copy has none")
    if str(out) in COURSE:
        raise CourseError(f"{out} is a module, not a folder: course quiz --modules {out} FOLDER")
    check_folder(out)
    # The figures are drawn by the site's own program, which is a package beside the pages.
    if str(DRAWN_BY) not in sys.path:
        sys.path.append(str(DRAWN_BY))
    contents = import_module("sitebuild.quiz.export").contents
    with ExitStack() as stack:
        kept = PROJECT / "out" / "docs" / "quiz"
        if not CHECKOUT:
            kept = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            # Interrupted, the processes that draw would go on to write into a folder that is being removed.
            stack.callback(import_module("sitebuild.mistakes.figures").STUDIO.close)
        asked, files = contents(modules, held_back=held_back, kept=kept)
    write_folder(files, out)
    click.echo(
        f"{out}: {count(asked, 'question')}, with answers: not for students. See README.md there."
    )
