"""Grade one submission: a worker for each module, every check once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from time import perf_counter

from course import __version__
from course.effects import MODULES
from course.grading.catalog import module_checks
from course.grading.checks.check import Check
from course.grading.checks.running import References, Result, run_checks
from course.grading.report import Report
from course.grading.worker.client import Limits, Worker
from course.grading.worker.sandbox import Sandbox, sandbox


def grade(
    sources: Mapping[str, bytes],
    references: References,
    *,
    seed: int = 0,
    modules: Iterable[str] = tuple(MODULES),
    student: str = "",
    limits: Limits | None = None,
    shut_in: Sandbox | None = None,
    only: Callable[[Check], bool] | None = None,
    each: Callable[[Result], None] | None = None,
) -> Report:
    """Grade the modules of one submission.

    Parameters
    ----------
    sources : module -> the student's file; a module that isn't there is not attempted
    references : arrays to compare with
    seed : chooses the parameters of scenes and checks
    only : which checks to run; all if not given
    each : called with every result as soon as it is there
    """
    limits = limits or Limits()
    shut_in = shut_in or sandbox()
    started = perf_counter()
    results: list[Result] = []
    printed: dict[str, str] = {}
    for module in modules:
        with Worker(module, sources.get(module, b""), limits, shut_in) as worker:
            for result in run_checks(module_checks(module), worker, references, seed, only):
                results.append(result)
                if each is not None:
                    each(result)
        if worker.printed:
            printed[module] = worker.printed
    return Report(
        student,
        tuple(results),
        printed,
        shut_in.protections,
        seed,
        __version__,
        perf_counter() - started,
    )
