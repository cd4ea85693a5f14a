"""Grade one submission: a worker for each module, every check once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager, ExitStack, nullcontext
from functools import partial
from pathlib import Path
from time import perf_counter

from course import __version__
from course.effects import COURSE
from course.grading.catalog import module_checks
from course.grading.checks.check import Caller, Check
from course.grading.checks.preparing import References
from course.grading.checks.result import Result, Status
from course.grading.checks.running import run_checks, unusable
from course.grading.errors import StudentError
from course.grading.pictures.whole import ALL, NAME, Together
from course.grading.references import SOLUTIONS, reference
from course.grading.report import Report
from course.grading.submissions import why_absent
from course.grading.worker.client import Worker
from course.grading.worker.limits import Limits
from course.grading.worker.patience import Patience
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
    folder: Path | None = None,
) -> Report:
    """Grade the modules of one submission.

    Parameters
    ----------
    sources : module -> the student's file; a module that isn't there is not attempted
    references : arrays to compare with
    seed : chooses the parameters of scenes and checks
    only : which checks to run; all if not given
    each : called with every result as soon as it is there
    folder : where the files should be, for what is said of those that aren't; only their names if not given
    """
    limits = limits or Limits()
    shut_in = shut_in or sandbox()
    started = perf_counter()
    results: list[Result] = []
    chosen = tuple(modules)
    with ExitStack() as stack:
        # A worker's process starts at its first call, so those of modules that nobody asks cost nothing.
        # Of some checks alone the first may be a large one.
        patience = {module: Patience(limits.call_seconds, only is None) for module in chosen}
        workers = {
            module: stack.enter_context(
                Worker(
                    module,
                    sources.get(module, b""),
                    limits,
                    shut_in,
                    patience=patience[module],
                    trouble=why_absent(module, sources.get(module), folder),
                )
            )
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
                        patience=patience[module],
                    )
                )
            return lenders[module, function]

        def tell(result: Result) -> None:
            results.append(result)
            if each is not None:
                each(result)

        lenders: dict[tuple[str, str], Worker] = {}
        for module in (*chosen, *([NAME] if set(ALL) <= set(chosen) else [])):
            checks = module_checks(module)
            caller: Caller
            if module in workers:
                caller = workers[module]
                error = (
                    _loaded(workers[module])
                    if any(only is None or only(check) for check in checks.checks)
                    else None
                )
                if error is not None:
                    for result in unusable(checks, error, only):
                        tell(result)
                    continue
            else:
                caller = Together(
                    workers,
                    {f"{r.module}.{r.function}" for r in results if r.status is Status.TIMEOUT},
                )
            with _yardstick(module, limits, shut_in) as yardstick:
                for result in run_checks(
                    checks,
                    caller,
                    references,
                    seed,
                    only,
                    yardstick,
                    partial(lend, module),
                ):
                    tell(result)
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


def _loaded(worker: Worker) -> StudentError | None:
    """Why the module can't be used; None if it can."""
    try:
        worker.load()
    except StudentError as error:
        return error
    return None


def _yardstick(
    module: str, limits: Limits, shut_in: Sandbox
) -> AbstractContextManager[Worker | None]:
    """The reference solution in a worker of its own, where there is one."""
    path = SOLUTIONS / f"{module}.py"
    return Worker(module, path.read_bytes(), limits, shut_in) if path.is_file() else nullcontext()
