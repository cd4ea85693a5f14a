"""`course regrade`: who changes when the grader has changed, before anything is written."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.errors import CourseError
from course.base.texts import count
from course.cli.classes import ClassOptions, class_options, tell_finished, tell_submissions
from course.cli.options import FOLDER

if TYPE_CHECKING:
    from course.school.grading.checks.result import Result
    from course.school.grading.classes.regrading import ScoreChange
    from course.school.grading.report import Report


@click.command()
@click.option("--out", type=FOLDER, required=True, help="Folder that `course grade` has written.")
@click.option(
    "--dry-run", is_flag=True, help="Tell who would change, and leave the grades as they are."
)
@class_options
def regrade(submissions: Path, out: Path, dry_run: bool, options: ClassOptions) -> None:
    """Grade a class again after a change to checks, scenes or solutions, and tell who changes by which check.

    Seed, modules, policy, roster and seconds are those of the grading before. What --dry-run has graded is kept, so
    that the same command without it only has to apply that.
    """
    from course.school.grading.classes.regrading import apply
    from course.school.grading.classes.regrading import regrade as grade_again
    from course.school.grading.classes.settings import read_settings

    settings = read_settings(out, options.submission_seconds)
    settings = settings.instead(options.policy, options.roster, options.title)
    # Before hours of grading.
    settings.read()
    with options.runner() as runner:
        regraded = grade_again(submissions, out, settings, runner)
    tell_submissions(regraded.result)
    for student in regraded.gone:
        click.echo(f"{student}: graded before, and there is no submission now", err=True)
    for change in regraded.changes:
        _tell(change)
    _tell_all(regraded.changes, len(regraded.result.reports), dry_run)
    if not dry_run:
        tell_finished(apply(regraded, out))
    if regraded.result.faults:
        raise CourseError(
            f"grader error, nobody's mistake: left as they were: {', '.join(regraded.result.faults)}; "
            "the same command grades them again"
        )


def _tell(change: ScoreChange) -> None:
    click.echo(f"{change.student}: {_score(change.before)} -> {_score(change.after)}")
    for before, after in change.checks:
        one = after or before
        assert one is not None
        click.echo(f"  {one.id}: {_ended(before)} -> {_ended(after)}")


def _tell_all(changes: tuple[ScoreChange, ...], students: int, dry_run: bool) -> None:
    points = sum(
        change.after.points - (change.before.points if change.before else 0.0) for change in changes
    )
    would = "would change" if dry_run else "changed"
    told = (
        f"{len(changes)} of {count(students, 'submission')} {would}, by {points:+g} points together"
    )
    click.echo(f"{told}; nothing was written" if dry_run else told)


def _score(report: Report | None) -> str:
    from course.school.grading.report import as_points

    if report is None:
        return "not graded before"
    if report.trouble:
        return "not gradable"
    return f"{as_points(report.points)} of {as_points(report.of)} points ({100.0 * report.score:.1f} %)"


def _ended(result: Result | None) -> str:
    from course.school.grading.report import as_points

    if result is None:
        return "no such check"
    return f"{result.status}, {as_points(result.points)} of {as_points(result.of)}"
