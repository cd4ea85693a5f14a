"""Grade one submission: a worker for each module, every check once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager, ExitStack, nullcontext
from functools import partial
from time import perf_counter

from course import __version__
from course.effects import COURSE
from course.grading.catalog import module_checks
from course.grading.checks.check import Caller, Check
from course.grading.checks.running import References, Result, run_checks
from course.grading.pictures.whole import ALL, NAME, Together
from course.grading.references import SOLUTIONS, reference
from course.grading.report import Report
from course.grading.worker.client import Limits, Worker
from course.grading.worker.sandbox import Sandbox, sandbox


def grade(
    sources: Mapping[str, bytes],
    references: References,
    *,
    seed: int = 0,
    modules: Iterable[str] = tuple(COURSE),
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
    chosen = tuple(modules)
    with ExitStack() as stack:
        # A worker's process starts at its first call, so those of modules that nobody asks cost nothing.
        workers = {
            module: stack.enter_context(Worker(module, sources.get(module, b""), limits, shut_in))
            for module in chosen
        }

        def lend(module: str, function: str) -> Caller | None:
            """The student's module again, the reference's functions before this one in place of the student's."""
            functions = COURSE.get(module, ())
            before = functions[: functions.index(function)] if function in functions else ()
            if not before or not (SOLUTIONS / f"{module}.py").is_file():
                return None
            if (module, function) not in lenders:
                lenders[module, function] = stack.enter_context(
                    Worker(
                        module,
                        sources.get(module, b""),
                        limits,
                        shut_in,
                        lender=reference(module),
                        lent=before,
                    )
                )
            return lenders[module, function]

        lenders: dict[tuple[str, str], Worker] = {}
        for module in (*chosen, *([NAME] if set(ALL) <= set(chosen) else [])):
            caller: Caller = workers[module] if module in workers else Together(workers)
            with _yardstick(module, limits, shut_in) as yardstick:
                for result in run_checks(
                    module_checks(module),
                    caller,
                    references,
                    seed,
                    only,
                    yardstick,
                    partial(lend, module),
                ):
                    results.append(result)
                    if each is not None:
                        each(result)
        printed = {module: worker.printed for module, worker in workers.items() if worker.printed}
    return Report(
        student,
        tuple(results),
        printed,
        shut_in.protections,
        seed,
        __version__,
        perf_counter() - started,
    )


def _yardstick(
    module: str, limits: Limits, shut_in: Sandbox
) -> AbstractContextManager[Worker | None]:
    """The reference solution in a worker of its own, where there is one."""
    path = SOLUTIONS / f"{module}.py"
    return Worker(module, path.read_bytes(), limits, shut_in) if path.is_file() else nullcontext()
