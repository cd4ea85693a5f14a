"""Grade one submission: a worker for each module, every check once."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

from course.base.texts import clean
from course.base.version import __version__
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks, with_whole
from course.school.grading.checks.check import Caller, Check, ModuleChecks, References
from course.school.grading.checks.lending import Substitutes
from course.school.grading.checks.result import Result, Status, cleaned, troubled
from course.school.grading.checks.running import run_checks
from course.school.grading.errors import StudentError
from course.school.grading.pictures.whole import ALL, NAME, Together
from course.school.grading.places import located
from course.school.grading.references import SOLUTIONS, reference
from course.school.grading.report import Report
from course.school.grading.submissions import why_absent
from course.school.grading.worker.client import Worker
from course.school.grading.worker.limits import Limits, TimeBudget, WorkerBudget
from course.school.grading.worker.sandbox import Sandbox, sandbox


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
    files: Mapping[str, Path] | None = None,
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
    files : module -> where its text is from, for the places that are told of; the text itself if not given
    """
    limits = limits or Limits()
    shut_in = shut_in or sandbox()
    started = perf_counter()
    results: list[Result] = []
    printed: dict[str, str] = {}
    chosen = tuple(modules)
    budget = WorkerBudget(limits)
    # Of some checks alone the first may be a large one.
    time_budget = {module: TimeBudget(limits.call_seconds, only is None) for module in chosen}

    reference_callers: dict[str, Worker] = {}

    def worker(module: str, **more: Any) -> Worker:
        source, shared = sources.get(module, b""), time_budget[module]
        found = Worker(module, source, limits, shut_in, time_budget=shared, budget=budget, **more)
        found.reference_caller = reference_callers.get(module)
        return found

    def right(module: str, budget: WorkerBudget | None = None) -> Worker:
        return Worker(module, _solution(module).read_bytes(), limits, shut_in, budget=budget)

    def tell(result: Result) -> None:
        result = cleaned(result)
        if (file := (files or {}).get(result.module)) is not None:
            result = located(result, file)
        results.append(result)
        if each is not None:
            each(result)

    with ExitStack() as stack:
        # A worker's process starts at its first call, so those of modules that nobody asks cost nothing.
        workers = {
            module: stack.enter_context(
                worker(module, trouble=why_absent(module, sources.get(module), folder))
            )
            for module in chosen
        }
        for module in with_whole(chosen):
            checks = module_checks(module)
            own = workers.get(module)
            caller: Caller | None = own
            if caller is None:
                late = {f"{r.module}.{r.function}" for r in results if r.status is Status.TIMEOUT}
                caller = Together(workers, late)
            asked = any(only is None or only(check) for check in checks.checks)
            error = _unloaded(own) if own is not None and asked else None
            needed = ALL if module == NAME else (module,)
            standard = partial(reference, module) if all(map(_is_solved, needed)) else None
            with (
                right(module) if _is_solved(module) else nullcontext() as reference_caller,
                _substitutes(module, worker, partial(right, module, budget)) as substitutes,
            ):
                if own is not None and reference_caller is not None:
                    own.reference_caller = reference_callers[module] = reference_caller
                for result in (
                    _unusable(checks, error, only)
                    if error is not None
                    else run_checks(
                        checks,
                        caller,
                        references,
                        seed,
                        only,
                        reference_caller,
                        substitutes,
                        standard,
                    )
                ):
                    tell(result)
            if own is not None:
                # No module's code goes on while another's is checked; the picture of all starts it again.
                own.close()
                own.reference_caller = None
                printed |= {module: clean(own.printed)} if own.printed else {}
    return Report(
        student,
        tuple(results),
        printed,
        shut_in.protections,
        seed,
        __version__,
        perf_counter() - started,
    )


@contextmanager
def _substitutes(
    module: str, worker: Callable[..., Worker], right: Callable[[], Worker]
) -> Iterator[Substitutes]:
    """The student's module again, for each function with the reference's in place of those before it.

    Only the latest is there: its processes end when another function is asked for, and at the end of the context.
    Nobody is there where no function comes before the one that is asked for, or there is no solution.
    """
    latest: dict[str, Worker] = {}

    def close() -> None:
        while latest:
            latest.popitem()[1].close()

    def lend(function: str) -> Caller | None:
        functions = COURSE.get(module, ())
        before = functions[: functions.index(function)] if function in functions else ()
        if not before or not _is_solved(module):
            return None
        if function not in latest:
            close()
            # What is lent is worked out where it can hold up or fill up nobody but the one who asks for it.
            latest[function] = worker(module, substitute=right(), lent=before)
        return latest[function]

    try:
        yield lend
    finally:
        close()


def _unusable(
    checks: ModuleChecks, error: StudentError, only: Callable[[Check], bool] | None = None
) -> Iterator[Result]:
    """Results where no function of the module can be called: none passes, and the first says why in full."""
    first = ""
    for check in filter(only, checks.checks):
        result = replace(troubled(checks.module, check, error), expected="", module_wide=True)
        yield replace(result, where="", same_as=first) if first else result
        first = first or result.id


def _solution(module: str) -> Path:
    return SOLUTIONS / f"{module}.py"


def _is_solved(module: str) -> bool:
    return _solution(module).is_file()


def _unloaded(worker: Worker) -> StudentError | None:
    """Why the module can't be used; None if it can."""
    try:
        worker.load()
    except StudentError as error:
        return error
    return None
