"""Grade one submission: a worker for each module, every check once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import AbstractContextManager, ExitStack, nullcontext
from functools import partial
from pathlib import Path
from time import perf_counter

from course import __version__
from course.grading.catalog import module_checks
from course.grading.checks.check import Caller, Check
from course.grading.checks.preparing import References
from course.grading.checks.result import Result, Status
from course.grading.checks.running import Standard, run_checks, unusable
from course.grading.errors import StudentError
from course.grading.pictures.whole import ALL, NAME, Together
from course.grading.references import SOLUTIONS, reference
from course.grading.report import Report
from course.grading.submissions import why_absent
from course.grading.worker.budget import Budget
from course.grading.worker.client import Worker
from course.grading.worker.limits import Limits
from course.grading.worker.patience import Patience
from course.grading.worker.sandbox import Sandbox, sandbox
from course.modules import COURSE


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
    printed: dict[str, str] = {}
    chosen = tuple(modules)
    budget = Budget(limits)
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
                    budget=budget,
                    trouble=why_absent(module, sources.get(module), folder),
                )
            )
            for module in chosen
        }

        def tell(result: Result) -> None:
            results.append(result)
            if each is not None:
                each(result)

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
                    printed |= _ended(workers[module])
                    continue
            else:
                caller = Together(
                    workers,
                    {f"{r.module}.{r.function}" for r in results if r.status is Status.TIMEOUT},
                )
            with (
                _yardstick(module, limits, shut_in) as yardstick,
                _Lenders(
                    module, sources.get(module, b""), limits, shut_in, patience.get(module), budget
                ) as lenders,
            ):
                for result in run_checks(
                    checks,
                    caller,
                    references,
                    seed,
                    only,
                    yardstick,
                    lenders,
                    _standard(module),
                ):
                    tell(result)
            if module in workers:
                # No module's code goes on while another's is checked; the picture of all starts it again.
                printed |= _ended(workers[module])
    return Report(
        student,
        tuple(results),
        printed,
        shut_in.protections,
        seed,
        __version__,
        perf_counter() - started,
    )


class _Lenders:
    """The student's module again, for each function with the reference's in place of those before it.

    Only the latest is there: its processes end when another function is asked for, and at the end of the context.
    """

    def __init__(
        self,
        module: str,
        source: bytes,
        limits: Limits,
        shut_in: Sandbox,
        patience: Patience | None,
        budget: Budget,
    ) -> None:
        self._module, self._source = module, source
        self._limits, self._shut_in = limits, shut_in
        self._patience, self._budget = patience, budget
        self._function = ""
        self._worker: Worker | None = None

    def __enter__(self) -> _Lenders:
        return self

    def __exit__(self, *_: object) -> None:
        self._close()

    def __call__(self, function: str) -> Caller | None:
        """None where no function comes before it, or there is no solution."""
        functions = COURSE.get(self._module, ())
        before = functions[: functions.index(function)] if function in functions else ()
        path = SOLUTIONS / f"{self._module}.py"
        if not before or not path.is_file():
            return None
        if function != self._function or self._worker is None:
            self._close()
            # What is lent is worked out where it can hold up or fill up nobody but the one who asks for it.
            right = Worker(
                self._module, path.read_bytes(), self._limits, self._shut_in, budget=self._budget
            )
            self._worker = Worker(
                self._module,
                self._source,
                self._limits,
                self._shut_in,
                lender=right,
                lent=before,
                patience=self._patience,
                budget=self._budget,
            )
            self._function = function
        return self._worker

    def _close(self) -> None:
        if self._worker is not None:
            self._worker.close()


def _standard(module: str) -> Standard | None:
    """The reference in this process; None where there is no solution."""
    needed = ALL if module == NAME else (module,)
    there = all((SOLUTIONS / f"{name}.py").is_file() for name in needed)
    return partial(reference, module) if there else None


def _loaded(worker: Worker) -> StudentError | None:
    """Why the module can't be used; None if it can."""
    try:
        worker.load()
    except StudentError as error:
        return error
    return None


def _ended(worker: Worker) -> dict[str, str]:
    """What a worker has printed, by module, now that it is closed; nothing if it hasn't."""
    worker.close()
    return {worker.module: worker.printed} if worker.printed else {}


def _yardstick(
    module: str, limits: Limits, shut_in: Sandbox
) -> AbstractContextManager[Worker | None]:
    """The reference solution in a worker of its own, where there is one."""
    path = SOLUTIONS / f"{module}.py"
    return Worker(module, path.read_bytes(), limits, shut_in) if path.is_file() else nullcontext()
