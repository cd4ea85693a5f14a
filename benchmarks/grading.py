"""What grading costs: one submission, a class, and the pipe between the grader and its workers."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

from benchmarks.figures import Figure, summary
from course.effects import MODULES, PROJECT
from course.grading.catalog import module_checks
from course.grading.checks.check import Caller, Check, ModuleChecks
from course.grading.checks.running import References, run_checks
from course.grading.grading import grade
from course.grading.known import known
from course.grading.pictures.whole import NAME
from course.grading.references import make_references, read_references, reference
from course.grading.worker.client import Worker

ROUNDS = 5
CLASS = 24
"""Submissions that are graded to tell how long 200 take."""


def measure_grading() -> list[Figure]:
    """Seconds of one submission, minutes of a class of 200, and a graded render with a worker / without."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "references.npz"
        make_references((*MODULES, NAME), 0, file)
        arrays = read_references(file, 0)
        return [_submission(arrays), _class(Path(folder)), *_pipe(arrays)]


def _submission(arrays: References) -> Figure:
    sources = {m: (PROJECT / "solutions" / f"{m}.py").read_bytes() for m in MODULES}
    seconds = [grade(sources, arrays).seconds for _ in range(ROUNDS)]
    return summary("six modules of one submission [s]", seconds, 20)


def _class(folder: Path) -> Figure:
    """A class of right and wrong submissions, as it comes."""
    for number in range(CLASS):
        student = folder / "class" / f"student {number}"
        student.mkdir(parents=True)
        for module in MODULES:
            found = known(module)
            (student / f"{module}.py").write_text(found[(7 * number) % len(found)].source)
    started = perf_counter()
    subprocess.run(
        [
            sys.executable,
            "-m",
            "course",
            "grade",
            str(folder / "class"),
            "--out",
            str(folder / "graded"),
        ],
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    minutes = (perf_counter() - started) / 60 * 200 / CLASS
    return summary(f"class of 200, from {CLASS} [min]", [minutes], 25)


def _pipe(arrays: References) -> list[Figure]:
    ratios: list[float] = []
    worst = ("", 0.0)
    for module in MODULES:
        inside = reference(module)
        with Worker(module, (PROJECT / "solutions" / f"{module}.py").read_bytes()) as worker:
            for check in module_checks(module).checks:
                if check.kind == "picture":
                    found = _ratio(module, check, worker, inside, arrays)
                    ratios.append(found)
                    worst = max(
                        worst, (f"{module}.{check.function}", found), key=lambda pair: pair[1]
                    )
    return [
        summary("graded render: with a worker / without", ratios, 1.15),
        summary(f"the same, worst ({worst[0]})", [worst[1]], 1.15),
    ]


def _ratio(module: str, check: Check, worker: Caller, inside: Caller, arrays: References) -> float:
    alone = ModuleChecks(module, (check,), ())
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS + 1):
        for caller, kept in zip((worker, inside), times, strict=True):
            (result,) = run_checks(alone, caller, arrays, 0)
            kept.append(result.seconds)
    # The first round imports and compiles.
    return median(a / b for a, b in zip(times[0][1:], times[1][1:], strict=True))
