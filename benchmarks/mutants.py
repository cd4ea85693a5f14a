"""`make mutants`: the kill matrix of all known submissions, each graded in a worker as a student's would be.

Exit code 1 when a wrong submission gets past the check meant for it, or a right one loses a point. ``--false-fail``
estimates instead how often a right submission fails by chance: the statistical checks alone, for thousands of seeds.
Both end with a table of the modules.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import click

from course.benchmarking.tables import NONE, Table
from course.effects import COURSE
from course.grading.catalog import module_checks
from course.grading.checks.preparing import prepared
from course.grading.checks.result import Status
from course.grading.checks.running import run_checks
from course.grading.known import Known, known
from course.grading.mutants import Verdict, judge, matrix
from course.grading.references import make_references, read_references, reference
from course.grading.worker.client import Worker
from course.grading.worker.limits import Limits

CHANCE = ("distribution", "order")
"""Kinds of checks in which chance decides; bias is estimated from its own distribution, for it renders."""

TOGETHER = "together"
"""The tables' last row."""


@click.command(help=__doc__)
@click.argument("modules", nargs=-1, metavar="[MODULE]...", type=click.Choice([*COURSE]))
@click.option("--seed", default=0, show_default=True)
@click.option("--jobs", default=2, show_default=True)
@click.option(
    "--false-fail",
    type=int,
    metavar="SEEDS",
    help="Estimate the false-fail rate over that many seeds.",
)
@click.option("--json", "json_file", type=click.Path(path_type=Path), help="Write the results.")
def main(
    modules: tuple[str, ...], seed: int, jobs: int, false_fail: int | None, json_file: Path | None
) -> None:
    """Print the matrix."""
    chosen = modules or tuple(COURSE)
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        if false_fail is not None:
            sys.exit(_false_fail(pool, chosen, false_fail, json_file))
        file = Path("out/mutants/references.npz")
        make_references(chosen, seed, file)
        submissions = [submission for module in chosen for submission in known(module)]
        verdicts = []
        for verdict in pool.map(
            _judged, submissions, [seed] * len(submissions), [file] * len(submissions)
        ):
            verdicts.append(verdict)
            print("\n".join(matrix([verdict])), flush=True)
    faults = sum(bool(verdict.fault) for verdict in verdicts)
    print(f"\n{kills(chosen, verdicts).markdown()}\n\n{faults} faults of the grader")
    if json_file:
        json_file.write_text(json.dumps([_plain(verdict) for verdict in verdicts], indent=1))
    sys.exit(1 if faults else 0)


def _judged(submission: Known, seed: int, file: Path) -> Verdict:
    arrays = read_references(file, seed)
    with Worker(
        submission.module, submission.source.encode(), Limits(call_seconds=60, cpu_seconds=600)
    ) as worker:
        return judge(submission, worker, arrays, seed)


def kills(modules: Sequence[str], verdicts: Sequence[Verdict]) -> Table:
    """How many right and wrong submissions of each module there are, and who is told the mistake."""

    def row(name: str, some: Sequence[Verdict]) -> tuple[str, ...]:
        wrong = [verdict for verdict in some if not verdict.submission.right]
        told = sum(bool(verdict.told) for verdict in wrong)
        return name, *map(str, (len(some) - len(wrong), len(wrong), told))

    rows = [
        row(module, [verdict for verdict in verdicts if verdict.submission.module == module])
        for module in modules
    ]
    columns = ("module", "right", "wrong", "of which told their mistake")
    return Table("", columns, (*rows, row(TOGETHER, verdicts)))


def _false_fail(
    pool: ProcessPoolExecutor, modules: tuple[str, ...], seeds: int, json_file: Path | None
) -> int:
    failed: list[str] = []
    stated, rows = 0.0, []
    for module in modules:
        checks = module_checks(module).checks
        by_chance = sum(check.kind in CHANCE for check in checks)
        if not by_chance:
            continue
        wrong = [
            one
            for some in pool.map(_chance, [module] * seeds, range(seeds), chunksize=25)
            for one in some
        ]
        by_design = sum(check.false_fail for check in checks)
        rows.append((module, str(by_chance), f"{seeds:,}", str(len(wrong)), f"{by_design:.1e}"))
        print(*wrong, sep="\n", end="\n" if wrong else "", flush=True)
        failed += wrong
        stated += by_design
    columns = ("module", "statistical checks", "seeds", "false fails", "stated by all its checks")
    total = (TOGETHER, NONE, NONE, str(len(failed)), f"{stated:.1e}")
    print(Table("", columns, (*rows, total)).markdown())
    if json_file:
        json_file.write_text(json.dumps({"seeds": seeds, "failed": failed, "by design": stated}))
    return 1 if failed else 0


def _chance(module: str, seed: int) -> list[str]:
    caller = reference(module)
    results = run_checks(
        module_checks(module),
        caller,
        prepared(caller, seed),
        seed,
        only=lambda check: check.kind in CHANCE,
    )
    return [f"{result.id} seed {seed}" for result in results if result.status is not Status.PASSED]


def _plain(verdict: Verdict) -> dict[str, object]:
    return {
        "module": verdict.submission.module,
        "name": verdict.submission.name,
        "right": verdict.submission.right,
        "failed": verdict.failed,
        "told": verdict.told,
        "fault": verdict.fault,
    }


if __name__ == "__main__":
    main()
