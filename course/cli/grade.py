"""`course grade`: what an instructor runs on the submissions of a class."""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.cli.options import modules_from
from course.cli.progress import progress_bar
from course.cli.tables import count
from course.errors import CourseError

if TYPE_CHECKING:
    from course.grading.classes.grading import ClassEngine, ClassResult


@click.command()
@click.argument("submissions", type=click.Path(path_type=Path, exists=True, file_okay=False))
@click.option(
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    required=True,
    help="Folder for the results; what an earlier run has left there is kept.",
)
@click.option(
    "--seed", type=click.IntRange(0), default=0, help="Chooses the parameters of scenes and checks."
)
@click.option(
    "--modules",
    multiple=True,
    callback=modules_from,
    metavar="MODULE[,MODULE]...",
    help="Grade only these.",
)
@click.option(
    "--jobs", type=click.IntRange(1), help="Submissions graded at a time.  [default: one a core]"
)
@click.option(
    "--engine",
    type=click.Choice(["processes", "dask"]),
    default="processes",
    show_default=True,
    help="Where to grade: on this machine or on a dask cluster.",
)
@click.option("--address", metavar="tcp://HOST:PORT", help="Of the dask scheduler.")
def grade(
    submissions: Path,
    out: Path,
    seed: int,
    modules: tuple[str, ...],
    jobs: int | None,
    engine: str,
    address: str | None,
) -> None:
    """Grade a class: every folder and .zip file in SUBMISSIONS, named after its student.

    Each student gets a folder in --out, and the class grades.csv and class.html. After an interruption the same
    command goes on where it stopped.
    """
    from course.grading.classes.grading import grade_class

    if (engine == "dask") != (address is not None):
        raise click.UsageError("--engine dask and --address go together")
    if engine == "dask" and jobs is not None:
        raise click.UsageError("--jobs is for --engine processes; a cluster has workers of its own")
    done, of = 0, 0
    with progress_bar("grading") as bar:

        def progress(now: int, total: int) -> None:
            nonlocal done, of
            done, of = now, total
            if bar is not None:
                bar(now / total, False)

        try:
            result = grade_class(
                submissions,
                out,
                _engine(jobs, address),
                seed=seed,
                modules=modules,
                send_references=engine == "dask",
                progress=progress,
            )
        except KeyboardInterrupt:
            click.echo(
                f"{done} of {count(of, 'submission')} graded and kept; the same command goes on from there",
                err=True,
            )
            raise
    _tell(result, out)


def _engine(jobs: int | None, address: str | None) -> ClassEngine:
    if address is not None:
        from course.grading.classes.cluster import on_cluster

        return partial(on_cluster, address=address)
    from course.grading.classes.processes import in_processes

    return partial(in_processes, jobs=jobs or os.cpu_count() or 1)


def _tell(result: ClassResult, out: Path) -> None:
    ungraded = [report for report in result.reports if report.trouble]
    for report in ungraded:
        click.echo(f"{report.student}: {report.trouble}", err=True)
    for student in result.doubtful:
        click.echo(
            f"{student}: a check had an error of its own; its points are given, "
            "and the same command checks it again",
            err=True,
        )
    kept = len(result.reports) - result.graded
    click.echo(
        f"{count(len(result.reports), 'submission')}: {result.graded} graded now, {kept} kept from before, "
        f"{len(ungraded)} not gradable"
    )
    if result.similar:
        click.echo(f"{count(len(result.similar), 'pair')} of modules alike; class.html lists them")
    click.echo(f"{out / 'grades.csv'} and {out / 'class.html'} written")
    if result.faults:
        raise CourseError(
            f"grader error, nobody's mistake: to be graded again: {', '.join(result.faults)}; "
            "the same command does that"
        )
