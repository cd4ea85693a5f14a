"""`course viva`: questions to a student about his or her own code."""

from pathlib import Path

import click

from course.base.atomic import write_text
from course.base.errors import CourseError
from course.base.texts import count
from course.cli.classes import trust_option
from course.cli.options import OUT_FILE, modules_from
from course.cli.outputs import check_outputs
from course.engine.functions.effects import PROJECT

QUESTIONS = 3


@click.command()
@click.argument("submission", type=click.Path(path_type=Path, exists=True))
@click.option("--html", type=OUT_FILE, help="Write a page with the pictures before and after.")
@click.option(
    "--modules",
    multiple=True,
    metavar="MODULE[,...]",
    callback=modules_from,
    help="Ask about these modules only.  [default: all that are there]",
)
@click.option("--seed", type=click.IntRange(0), default=0, help="Choose other questions.")
@trust_option
def viva(
    submission: Path, html: Path | None, modules: tuple[str, ...], seed: int, trusted: bool
) -> None:
    """Ask three questions about the code in SUBMISSION, one student's folder, archive or file.

    Each changes one place in a function that is right, makes the change, and says what comes of it. The answers are
    for the instructor. The student's code runs as in `course grade`.
    """
    from course.base.texts import clean
    from course.school.grading.classes.submitted import read_one
    from course.school.grading.references import references
    from course.school.grading.viva.asking import viva as questions
    from course.school.grading.worker.sandbox import protected, sandbox

    solutions = PROJECT / "solutions"
    if not solutions.is_dir():
        raise CourseError("questions need the solutions to compare with, and this copy has none")
    check_outputs(files=[("--html", html)])
    found = read_one(submission.stem, submission, modules)
    if found.trouble:
        raise CourseError(f"{submission}: {found.trouble}")
    sources = found.sources
    shut_in = sandbox(secrets=(submission,)) if trusted else protected((submission,))
    asked = []
    for one in questions(
        sources,
        solutions,
        references(),
        shut_in,
        questions=QUESTIONS,
        seed=seed,
        each=lambda name: click.echo(f"changing {name}", err=True),
    ):
        asked.append(one)
        click.echo(f"\n{len(asked)}. {one.module}.{one.change.function}: {one.asks}")
        click.echo(f"     {clean(one.change.before)}\n  -> {clean(one.change.after)}")
        for said in one.told:
            click.echo(f"   {clean(said)}")
    if not asked:
        raise CourseError(
            f"{submission}: no function is right, written by the student and changed to any effect; "
            "`course check` says what is wrong"
        )
    if len(asked) < QUESTIONS:
        click.echo(f"\nonly {count(len(asked), 'question')}: too few functions are right", err=True)
    if html is not None:
        from course.school.grading.report import Report
        from course.school.grading.reports.viva import viva_page

        unprotected = Report("", (), protections=shut_in.protections).unprotected
        write_text(html, viva_page(submission.resolve().stem, asked, unprotected))
        click.echo(f"\n{html} written: with answers, not for the student")
