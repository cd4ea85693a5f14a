"""`course grade`: what an instructor runs on the submissions of a class."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.errors import CourseError
from course.base.texts import count
from course.cli.classes import ClassOptions, class_options, tell_finished, tell_submissions
from course.cli.options import FAILED, OUT_FOLDER, choice_options

if TYPE_CHECKING:
    from course.school.grading.classes.grading import ClassResult


@click.command()
@click.option(
    "--out",
    type=OUT_FOLDER,
    required=True,
    help="Folder for the results; what an earlier run has left there is kept.",
)
@choice_options
@class_options
def grade(
    submissions: Path, out: Path, seed: int, modules: tuple[str, ...], options: ClassOptions
) -> None:
    """Grade a class: whatever lies in SUBMISSIONS, folders, archives and files named after their students.

    Each student gets a folder in --out, and the class grades.csv and class.html. What can't be graded has a row that
    says why. After an interruption the same command goes on where it stopped.
    """
    from course.school.grading.classes.grading import grade_class
    from course.school.grading.classes.settings import GradingSettings

    settings = GradingSettings(seed, modules, submission_seconds=options.submission_seconds)
    settings = settings.instead(options.policy, options.roster, options.title)
    with options.runner() as runner:
        result = grade_class(submissions, out, settings, runner)
    _tell(result)


def _tell(result: ClassResult) -> None:
    from course.school.grading.report import as_points

    tell_submissions(result)
    for report in result.reports:
        for broken in report.broken:
            click.echo(
                f"{report.student}: the check {broken.id} broke, "
                f"{as_points(broken.points)} of {as_points(broken.of)} points given; "
                f"the same command checks it again\n{broken.instructor.rstrip()}",
                err=True,
            )
    kept = len(result.reports) - result.graded
    ungraded = sum(bool(report.trouble) for report in result.reports)
    click.echo(
        f"{count(len(result.reports), 'submission')}: {result.graded} graded now, {kept} kept from before, "
        f"{ungraded} not gradable"
    )
    tell_finished(result.finished)
    if result.doubtful and not result.faults:
        click.echo("checks broke; grades.csv and class.html say which", err=True)
        sys.exit(FAILED)
    if result.faults:
        raise CourseError(
            f"grader error, nobody's mistake: to be graded again: {', '.join(result.faults)}; "
            "the same command does that"
        )
