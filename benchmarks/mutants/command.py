"""`make mutants`: the kill matrix of all known submissions, each graded in a worker as a student's would be.

Exit code 1 when a wrong submission gets past the check meant for it, a right one loses a point, or points aren't fair:
what is of no use earns a quarter at most, what is wrong in a corner only four fifths at least. ``--record`` writes
status, mistake and points of every check of every submission, and for the grader which checks a mistake explains;
``--compare`` names all that has changed since, and ends with 1 where something has: the referee of changes that are to
change no score. ``--varied`` prints what the checks' arguments have been, and what is never varied;
``--habits`` what right functions lose that are written in other ways, ``--cells`` what right submissions lose as
notebooks. ``--false-fail``
estimates how often a right submission fails by chance: the statistical checks alone, for thousands of seeds. All end
with a table of the modules.
"""

import json
import sys
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path

import click

from benchmarks.mutants.cells import as_notebook
from benchmarks.mutants.habits import HABITS, lost_by
from benchmarks.mutants.judging import (
    Verdict,
    changes,
    explaining,
    judge,
    marks,
    matrix,
    recorded,
    unfair,
)
from benchmarks.mutants.variants import variants
from benchmarks.mutants.varied import gaps
from benchmarks.mutants.varied import varied as varied_by_checks
from course.base.atomic import write_rows
from course.benchmarking.tables import NONE, Table
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.known import KnownSubmission, known, trusted
from course.school.grading.references import make_references, prepared, read_references, reference
from course.school.grading.worker.client import Worker
from course.school.grading.worker.limits import Limits

CHANCE = ("distribution", "order")
"""Kinds of checks in which chance decides; bias is estimated from its own distribution, for it renders."""

EXPLAINED = PROJECT / "course/school/grading/data/explained.json"
"""Where the grader reads which checks a mistake explains."""

RENDERED = ("picture", "bias", "speed")
"""Kinds of checks that are left out for variants, of which there are many."""

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
@click.option(
    "--habits",
    type=int,
    metavar="SEEDS",
    help="Check the reference, written by other habits, over that many seeds.",
)
@click.option("--cells", is_flag=True, help="Grade the right submissions as notebooks only.")
@click.option("--varied", is_flag=True, help="Print what the checks vary, and what they never do.")
@click.option("--json", "json_file", type=click.Path(path_type=Path), help="Write the results.")
@click.option("--record", type=click.Path(path_type=Path), help="Write what became of each check.")
@click.option("--compare", type=click.Path(path_type=Path, exists=True), help="With such a file.")
def main(
    modules: tuple[str, ...],
    seed: int,
    jobs: int,
    false_fail: int | None,
    habits: int | None,
    cells: bool,
    varied: bool,
    json_file: Path | None,
    record: Path | None,
    compare: Path | None,
) -> None:
    """Print the matrix."""
    chosen = modules or tuple(COURSE)
    if varied:
        sys.exit(_varied(chosen, json_file))
    with (
        ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool,
        tempfile.TemporaryDirectory() as folder,
    ):
        if false_fail is not None:
            sys.exit(_false_fail(pool, chosen, false_fail, json_file))
        if habits is not None:
            sys.exit(_habits(pool, chosen, habits, json_file))
        file = Path(folder) / "references.npz"
        make_references(chosen, seed, file)
        submissions = [submission for module in chosen for submission in known(module)]
        if cells:
            submissions = [as_notebook(one, seed) for one in submissions if one.right]
        verdicts = []
        for verdict in pool.map(
            _judged, submissions, [seed] * len(submissions), [file] * len(submissions)
        ):
            verdicts.append(verdict)
            print("\n".join(matrix([verdict])), flush=True)
        if cells:
            print(
                f"\n{len(verdicts)} notebooks, {sum(bool(one.fault) for one in verdicts)} lost points"
            )
            sys.exit(any(verdict.fault for verdict in verdicts))
        print(f"\n{kills(chosen, verdicts).markdown()}\n\n{fairness(chosen, verdicts).markdown()}")
        others = [variant for module in chosen for variant in variants(module)]
        others_judged = [
            *pool.map(_by_function, others, [seed] * len(others), [file] * len(others))
        ]
    print(f"\n{variety(chosen, others_judged).markdown()}")
    told_wrongly = [one for one in others_judged if one.told not in ("", one.submission.mistake)]
    missed = [one for one in others_judged if not one.failed]
    for one in (*told_wrongly, *missed):
        print(f"{one.submission.module} {one.submission.name}: {one.told or 'not caught'}")
    faults = sum(bool(verdict.fault) for verdict in verdicts) + len(told_wrongly) + len(missed)
    print(f"\n{faults} faults of the grader")
    if json_file:
        json_file.write_text(json.dumps([_plain(verdict) for verdict in verdicts], indent=1))
    found = recorded(verdicts)
    if record:
        write_rows(record, found, depth=3)
        if set(chosen) == set(COURSE):
            write_rows(EXPLAINED, explaining(found, submissions), depth=1)
    changed = changes(json.loads(compare.read_text()), found) if compare else []
    print(*changed, sep="\n", end="\n" if changed else "")
    sys.exit(1 if faults or changed else 0)


def _judged(submission: KnownSubmission, seed: int, file: Path) -> Verdict:
    arrays = read_references(file, seed)
    with Worker(
        submission.module, submission.source.encode(), Limits(call_seconds=60, cpu_seconds=600)
    ) as worker:
        verdict = judge(submission, worker, arrays, seed)
    if submission.right:
        return verdict
    found = marks(verdict)
    return replace(verdict, fault=verdict.fault or unfair(found), marks=found)


def _by_function(submission: KnownSubmission, seed: int, file: Path) -> Verdict:
    """A variant, by the checks of its function that render nothing."""
    return judge(
        submission,
        trusted(submission),
        read_references(file, seed),
        seed,
        lambda check: check.function == submission.function and check.kind not in RENDERED,
    )


def fairness(modules: Sequence[str], verdicts: Sequence[Verdict]) -> Table:
    """What functions earn that are of no use, and those that are wrong in a corner only, as shares of their points."""

    def row(name: str, some: Sequence[Verdict]) -> tuple[str, ...]:
        found = [verdict.marks for verdict in some if verdict.marks is not None]
        useless = [one.share for one in found if one.useless]
        corner = [one.share for one in found if one.right_elsewhere]
        most = f"{max(useless):.0%}" if useless else NONE
        least = f"{min(corner):.0%}" if corner else NONE
        return name, str(len(useless)), most, str(len(corner)), least

    columns = ("module", "of no use", "earn at most", "wrong in a corner", "earn at least")
    return Table("", columns, (*_by_module(modules, verdicts, row), row(TOGETHER, verdicts)))


def variety(modules: Sequence[str], verdicts: Sequence[Verdict]) -> Table:
    """How many variants of wrong submissions are caught, and named as the originals are."""

    def row(name: str, some: Sequence[Verdict]) -> tuple[str, ...]:
        meant = [one for one in some if one.submission.mistake]
        rightly = sum(one.told == one.submission.mistake for one in meant)
        wrongly = sum(one.told not in ("", one.submission.mistake) for one in some)
        caught = sum(bool(one.failed) for one in some)
        return name, *map(str, (len(some), caught, len(meant), rightly, wrongly))

    columns = ("module", "variants", "caught", "with a name", "named rightly", "named wrongly")
    return Table("", columns, (*_by_module(modules, verdicts, row), row(TOGETHER, verdicts)))


def _by_module(
    modules: Sequence[str],
    verdicts: Sequence[Verdict],
    row: Callable[[str, Sequence[Verdict]], tuple[str, ...]],
) -> list[tuple[str, ...]]:
    return [row(name, [v for v in verdicts if v.submission.module == name]) for name in modules]


def kills(modules: Sequence[str], verdicts: Sequence[Verdict]) -> Table:
    """How many submissions of each module are judged rightly, and what is told to those who are wrong."""

    def row(name: str, some: Sequence[Verdict]) -> tuple[str, ...]:
        wrong = [one for one in some if not one.submission.right]
        rightly = sum(bool(one.told) and one.told == one.submission.mistake for one in wrong)
        wrongly = sum(one.told not in ("", one.submission.mistake) for one in wrong)
        failing = [r for one in wrong for r in one.results if r.status is Status.FAILED]
        shown = sum(bool(result.example) for result in failing)
        numbers = (len(some) - len(wrong), len(wrong), rightly, wrongly, len(failing), shown)
        return name, *map(str, numbers)

    rows = _by_module(modules, verdicts, row)
    columns = ("module", "right", "wrong", "named rightly", "named wrongly")
    columns += ("failing checks", "with their smallest input")
    return Table("", columns, (*rows, row(TOGETHER, verdicts)))


def _habits(
    pool: ProcessPoolExecutor, modules: tuple[str, ...], seeds: int, json_file: Path | None
) -> int:
    """Right functions by each habit in turn, a seed each: how many checks were made, and what failed."""
    rows, failed = [], []
    for module in modules:
        wrong = [
            one
            for some in pool.map(_by_habit, [module] * seeds, range(seeds), chunksize=5)
            for one in some
        ]
        rows.append((module, str(len(HABITS)), str(seeds), str(len(wrong))))
        print(*wrong, sep="\n", end="\n" if wrong else "", flush=True)
        failed += wrong
    print(Table("", ("module", "habits", "seeds", "lost points"), tuple(rows)).markdown())
    if json_file:
        json_file.write_text(json.dumps({"seeds": seeds, "failed": failed}, indent=1) + "\n")
    return 1 if failed else 0


def _by_habit(module: str, seed: int) -> list[str]:
    habit = [*HABITS][seed % len(HABITS)]
    return [f"{habit}: {lost} seed {seed}" for lost in lost_by(module, habit, seed)]


def _varied(modules: tuple[str, ...], json_file: Path | None) -> int:
    """A table of what each argument has been, and a line for everything that is never varied."""
    rows, missing = [], []
    for module in modules:
        seen = varied_by_checks(module)
        missing += gaps(module, seen)
        for function, called in seen.items():
            for name, found in called.arguments.items():
                rows.append((f"{module}.{function}", name, *found.row))
    columns = ("function", "argument", "signs", "sizes", "octants", "dtypes", "layouts", "columns")
    print(Table("", columns, tuple(rows)).markdown())
    print(*missing, sep="\n")
    if json_file:
        write_rows(json_file, {"seen": rows, "never varied": missing}, depth=2)
    return 1 if missing else 0


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
