"""What grading costs: one submission, a class, and the pipe between the grader and its workers."""

import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from statistics import median
from time import perf_counter

from benchmarks.figures import Figure, summary
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, MODULES
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Caller, Check, ModuleChecks, References
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.grading import grade
from course.school.grading.known import known
from course.school.grading.pictures.whole import NAME
from course.school.grading.references import make_references, read_references, reference
from course.school.grading.worker.client import Worker

ROUNDS = 5
CLASS = 24
"""Right and wrong submissions that are graded to tell how long 200 take."""

CLASS_MINUTES = 25
"""For the core modules of 200 submissions."""

RENDERS = ("picture", "bias")
"""Kinds of checks that render."""

Times = list[tuple[float, float]]
"""Seconds with a worker and without, round by round."""


def measure_grading() -> list[Figure]:
    """Seconds of one submission, minutes of a class of 200, and graded renders with workers / without."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "references.npz"
        make_references((*COURSE, NAME), 0, file)
        arrays = read_references(file, 0)
        return [
            _submission(f"{len(MODULES)} core modules of one submission [s]", MODULES, arrays, 6),
            _submission(f"all {len(COURSE)} modules of one submission [s]", COURSE, arrays, 12),
            _class(f"{len(MODULES)} core modules", MODULES, Path(folder) / "core", CLASS_MINUTES),
            _class(
                f"all {len(COURSE)} modules",
                COURSE,
                Path(folder) / "all",
                # As long for a module as for one of the core.
                CLASS_MINUTES / len(MODULES) * len(COURSE),
            ),
            *_pipe(arrays),
        ]


def _submission(name: str, modules: Iterable[str], arrays: References, goal: float) -> Figure:
    sources = {m: (PROJECT / "solutions" / f"{m}.py").read_bytes() for m in modules}
    seconds = [grade(sources, arrays, modules=sources).seconds for _ in range(ROUNDS)]
    return summary(name, seconds, goal)


def _class(name: str, modules: Iterable[str], folder: Path, goal: float) -> Figure:
    """A class of right and wrong submissions, as it comes."""
    for number in range(CLASS):
        student = folder / "class" / f"student {number}"
        student.mkdir(parents=True)
        for module in modules:
            found = known(module)
            (student / f"{module}.py").write_text(found[(7 * number) % len(found)].source)
    command = [sys.executable, "-m", "course", "grade", str(folder / "class")]
    command += ["--modules", ",".join(modules), "--out", str(folder / "graded")]
    started = perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    minutes = (perf_counter() - started) / 60 * 200 / CLASS
    return summary(f"a class of 200, {name}, from {CLASS} submissions [min]", [minutes], goal)


def _pipe(arrays: References) -> list[Figure]:
    """What workers add to the checks that render: to all of them together, and to single pictures."""
    found: dict[str, Times] = {}
    singles: dict[str, float] = {}
    for module in COURSE:
        renders = [check for check in module_checks(module).checks if check.kind in RENDERS]
        if not renders:
            continue
        inside = reference(module)
        with Worker(module, (PROJECT / "solutions" / f"{module}.py").read_bytes()) as worker:
            for check in renders:
                times = _times(module, check, worker, inside, arrays)
                found[f"{module}.{check.function}/{check.name}"] = times
                if check.kind == "picture":
                    singles[f"{module}.{check.function}"] = median(_ratios(times))
    together: Times = [_sums(round_) for round_ in zip(*found.values(), strict=True)]
    worst = max(singles, key=lambda name: singles[name])
    return [
        summary(
            f"graded renders through workers / without, all {len(found)} together",
            _ratios(together),
            1.15,
        ),
        summary("a single picture, median and range", [*singles.values()], 1.15),
        summary(f"a single picture, the worst ({worst})", [singles[worst]], 1.15),
    ]


def _times(module: str, check: Check, worker: Caller, inside: Caller, arrays: References) -> Times:
    """Of one check, in turn."""
    alone = ModuleChecks(module, (check,), ())
    times: Times = []
    for _ in range(ROUNDS + 1):
        pair = []
        for caller in (worker, inside):
            (result,) = run_checks(alone, caller, arrays, 0)
            assert result.status is Status.PASSED, result
            pair.append(result.seconds)
        times.append((pair[0], pair[1]))
    # The first round imports and compiles.
    return times[1:]


def _sums(times: Iterable[tuple[float, float]]) -> tuple[float, float]:
    with_worker, without = zip(*times, strict=True)
    return sum(with_worker), sum(without)


def _ratios(times: Times) -> list[float]:
    return [with_worker / without for with_worker, without in times]
