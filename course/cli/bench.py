"""`course bench`: error over samples and over run time, for each module's scene and each estimator."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.base.atomic import make_folder, write_text
from course.base.errors import CourseError, OutputError
from course.base.progress import progress_bar
from course.cli import options
from course.cli.outputs import check_outputs, is_same_file
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, MODULES

if TYPE_CHECKING:
    from course.benchmarking.estimators import Estimator, Module
    from course.benchmarking.measuring import Effort, Measured

DOCUMENTS = PROJECT / "docs"
FURTHER = ("blurred_transparency", "textures")
KNOWN = (*MODULES, *FURTHER)
EXACT = ("film",)
"""Modules that estimate nothing, so that there is no error to be measured."""

ELSEWHERE = tuple(module for module in COURSE if module not in (*KNOWN, *EXACT))
"""Modules whose measurements are programs of their own: `python -m benchmarks NAME`."""


def _modules(
    _ctx: click.Context, _argument: click.Parameter, names: tuple[str, ...]
) -> tuple[str, ...]:
    """Return the names of modules that are measured here."""
    for name in names:
        if name in ELSEWHERE:
            raise click.BadParameter(
                f"{name} is measured by `python -m benchmarks {name}`; here are {', '.join(KNOWN)}"
            )
        if name not in KNOWN:
            raise click.BadParameter(
                f"{name!r}; the modules measured here are {', '.join(KNOWN)}, and"
                f" `python -m benchmarks NAME` measures {', '.join(ELSEWHERE)}"
            )
    return names


LISTED = f"""Modules: {", ".join(KNOWN)}.

`python -m benchmarks NAME` measures the others: {", ".join(ELSEWHERE)}."""


@click.command(epilog=LISTED)
@click.argument("modules", metavar="[MODULE]...", nargs=-1, callback=_modules)
@click.option(
    "--estimator",
    "words",
    multiple=True,
    help="Only estimators whose name holds this text, such as sobol, or ball; may be repeated.",
)
@click.option("--quick", is_flag=True, help="Smaller pictures and fewer samples: about a minute.")
@click.option(
    "--height",
    type=click.IntRange(11, 4096),
    help="Height of the pictures in pixels.  [default: 80, quick 48]",
)
@click.option(
    "--references",
    default=Path("out", "references"),
    show_default=True,
    type=options.PATH,
    help="Folder where converged pictures are kept.",
)
@click.option(
    "--json",
    "json_path",
    metavar="FILE",
    callback=options.json_path,
    help="Write everything that was measured as JSON.",
)
@click.option(
    "--plots", metavar="DIR", type=options.PATH, help="Write plots as SVG; needs the extra `bench`."
)
@click.option(
    "--write-docs",
    is_flag=True,
    help="Write tables into docs/accuracy.md and docs/performance.md, and the plots' numbers into docs/data.",
)
def bench(
    modules: tuple[str, ...],
    words: tuple[str, ...],
    quick: bool,
    height: int | None,
    references: Path,
    json_path: Path | None,
    plots: Path | None,
    write_docs: bool,
) -> None:
    """Measure how error falls with samples and with run time.

    For each MODULE (without one, those of the core, or with --write-docs all) its scene in scenes/ is rendered by
    several estimators with several seeds, and compared with a converged picture, which is rendered first and kept. The
    core takes about a quarter of an hour.
    """
    from course.benchmarking.estimators import BENCHED, FURTHER_BENCHED
    from course.benchmarking.machine import machine
    from course.benchmarking.measuring import FULL, QUICK
    from course.benchmarking.tables import print_tables, summary_table

    effort = QUICK if quick else FULL
    effort = replace(effort, height=height or effort.height)
    if write_docs and words:
        raise click.UsageError("--write-docs is for all estimators: leave --estimator out")
    known = BENCHED | FURTHER_BENCHED
    names = modules or (known if write_docs else BENCHED)
    chosen = _chosen([known[name] for name in dict.fromkeys(names)], words)
    _prepare(json_path, plots, write_docs)
    results = []
    for module, estimators in chosen:
        measured = _measure(module, estimators, effort, references)
        results.append(measured)
        print_tables([summary_table(measured)])
        click.echo()
    made_with = machine()
    if json_path is not None:
        write_text(json_path, to_json(results, effort, made_with))
    if plots:
        _plot(results, plots, made_with["processor"])
    if write_docs:
        from course.benchmarking.documents import write_documents

        for path in write_documents(results, effort, made_with, DOCUMENTS):
            click.echo(f"written: {path}", err=True)


def to_json(results: Sequence[Measured], effort: Effort, machine: dict[str, str]) -> str:
    """Everything that was measured."""
    data = {
        "machine": machine,
        "effort": vars(effort),
        "modules": [measured.to_dict() for measured in results],
    }
    return json.dumps(data, indent=1, allow_nan=False) + "\n"


def _chosen(
    modules: Sequence[Module], words: Sequence[str]
) -> list[tuple[Module, tuple[Estimator, ...]]]:
    """The modules, each with the estimators whose names hold one of the words; all where there is no word."""
    for word in words:
        if not any(_holds(e, word) for module in modules for e in module.estimators):
            names = dict.fromkeys(e.name for module in modules for e in module.estimators)
            raise CourseError(f"no estimator is named like {word!r}; there are {', '.join(names)}")
    chosen = [
        (
            module,
            tuple(e for e in module.estimators if not words or any(_holds(e, w) for w in words)),
        )
        for module in modules
    ]
    return [(module, estimators) for module, estimators in chosen if estimators]


def _holds(estimator: Estimator, word: str) -> bool:
    return word.lower() in estimator.name.lower()


def _prepare(json_path: Path | None, plots: Path | None, write_docs: bool) -> None:
    """Find out before the work whether its results can be written."""
    check_outputs(files=[("--json", json_path)])
    if plots:
        from course.benchmarking.plots import check_matplotlib

        if json_path is not None and is_same_file(json_path, plots):
            raise OutputError(f"--json {json_path} is the folder of --plots: give it another name")
        make_folder(plots)
        check_matplotlib()
    if write_docs:
        from course.benchmarking.documents import check_documents

        check_documents(DOCUMENTS)


def _measure(
    module: Module, estimators: tuple[Estimator, ...], effort: Effort, references: Path
) -> Measured:
    from course.benchmarking.measuring import measure

    with progress_bar(module.name) as report:
        tick = None if report is None else (lambda done: report(done, False))
        return measure(module, estimators, effort, folder=references, tick=tick)


def _plot(results: Sequence[Measured], folder: Path, note: str) -> None:
    from course.benchmarking.plots import write_comparisons

    for measured in results:
        for path in write_comparisons(measured, folder, note):
            click.echo(f"written: {path}", err=True)
