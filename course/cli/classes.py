"""Shared by `course grade` and `course regrade`: options, progress, and the summary at the end."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields
from functools import partial, wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from course.base.progress import progress_bar
from course.base.texts import count
from course.cli.options import FOLDER, seconds

if TYPE_CHECKING:
    from course.school.grading.classes.grading import ClassEngine, ClassResult, Finished, Runner

MOST_REMARKS = 12
"""Lines on submissions that are printed; class.html has them all."""

_FILE = click.Path(path_type=Path, exists=True, dir_okay=False)


trust_option = click.option(
    "--trust-submissions",
    "trusted",
    is_flag=True,
    help="Grade where their code can't be kept from reading solutions or changing grades, too; reports say so.",
)

_OPTIONS = (
    click.argument("submissions", type=FOLDER),
    click.option(
        "--policy",
        type=_FILE,
        help="YAML file of weights, late days, attempts and rounding: writes raw, adjusted and final scores.",
    ),
    click.option(
        "--roster",
        type=_FILE,
        help="CSV file of the class: writes canvas.csv and moodle.csv, and tells whose work is missing.",
    ),
    click.option("--title", help="The assignment as Canvas and Moodle name it, with --roster."),
    click.option(
        "--jobs",
        type=click.IntRange(1),
        help="Submissions graded at a time.  [default: one a core]",
    ),
    click.option(
        "--engine",
        type=click.Choice(["processes", "dask"]),
        default="processes",
        show_default=True,
        help="Where to grade: on this machine or on a dask cluster.",
    ),
    click.option("--address", metavar="tcp://HOST:PORT", help="Of the dask scheduler."),
    click.option(
        "--submission-seconds",
        metavar="SECONDS",
        callback=seconds,
        help="Time for all checks of one submission; what hasn't been called by then is given no points. "
        "[default: no limit]",
    ),
    trust_option,
)


@dataclass(frozen=True)
class ClassOptions:
    """Options of `course grade` and `course regrade` for grading.

    Attributes
    ----------
    policy, roster, title : what makes grades of points
    jobs, engine, address : where to grade
    submission_seconds : that all checks of one submission may take; None for no limit
    trusted : whether to grade where the code can't be kept from doing harm, too
    """

    policy: Path | None
    roster: Path | None
    title: str | None
    jobs: int | None
    engine: str
    address: str | None
    submission_seconds: float | None
    trusted: bool

    def class_engine(self) -> ClassEngine:
        """The cluster or the processes that grade; raises ``UsageError`` where options don't go together."""
        if (self.engine == "dask") != (self.address is not None):
            raise click.UsageError("--engine dask and --address go together")
        if self.address is None:
            from course.school.grading.classes.engines import in_processes

            return partial(in_processes, jobs=self.jobs or os.cpu_count() or 1)
        if self.jobs is not None:
            raise click.UsageError("--jobs is for --engine processes; a cluster has its own")
        from course.school.grading.classes.engines import on_cluster

        return partial(on_cluster, address=self.address)

    @contextmanager
    def runner(self) -> Iterator[Runner]:
        """Settings for grading, with a progress bar; raises ``UsageError`` as `class_engine` does."""
        from course.school.grading.classes.grading import Runner

        engine = self.class_engine()
        with class_progress() as progress:
            yield Runner(engine, self.address is not None, self.trusted, progress)


def class_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add SUBMISSIONS and the options to a command, which gets the latter together as ``options``."""

    @wraps(command)
    def run(**values: Any) -> None:
        given = {field.name: values.pop(field.name) for field in fields(ClassOptions)}
        command(**values, options=ClassOptions(**given))

    for option in reversed(_OPTIONS):
        run = option(run)
    return run


@contextmanager
def class_progress() -> Iterator[Callable[[int, int], None]]:
    """A progress bar; after Ctrl-C it is told what is kept."""
    done, of = 0, 0
    with progress_bar("grading") as bar:

        def progress(now: int, total: int) -> None:
            nonlocal done, of
            done, of = now, total
            if bar is not None:
                bar(now / total, False)

        try:
            yield progress
        except KeyboardInterrupt:
            click.echo(
                f"{done} of {count(of, 'submission')} graded and kept; the same command goes on from there",
                err=True,
            )
            raise


def tell_submissions(result: ClassResult) -> None:
    """Print who can't be graded, and what was guessed or left out."""
    for report in result.reports:
        if report.trouble:
            click.echo(f"{report.student}: {report.trouble}", err=True)
    remarks = [(one.student, remark) for one in result.submissions for remark in one.remarks]
    for student, remark in remarks[:MOST_REMARKS]:
        click.echo(f"{student}: {remark}", err=True)
    if len(remarks) > MOST_REMARKS:
        click.echo(f"{len(remarks) - MOST_REMARKS} remarks more: class.html has them all", err=True)


def tell_finished(finished: Finished) -> None:
    """Print what came of the class as a whole."""
    compared, matched = finished.compared, finished.matched
    if compared.similar:
        click.echo(
            f"{count(len(compared.similar), 'pair')} of modules alike; class.html lists them"
        )
    if compared.left_out:
        click.echo(f"{count(len(compared.left_out), 'file')} not compared; class.html lists them")
    for name in finished.unused:
        click.echo(f"the policy names {name}, who has handed in nothing", err=True)
    for told in finished.told:
        click.echo(told, err=True)
    if matched is not None:
        for text, names in (
            ("submissions of nobody in the roster", matched.unknown),
            ("in the roster, without a submission", matched.without),
        ):
            if names:
                click.echo(f"{text}: {'; '.join(names)}", err=True)
    if finished.unprotected:
        click.echo(f"{finished.unprotected}: no grade is certain", err=True)
    *first, last = map(str, finished.files)
    click.echo(f"{', '.join(first)} and {last} written")
