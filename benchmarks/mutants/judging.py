"""The kill matrix: every known wrong submission fails at the check meant for it, every right one earns full marks."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from benchmarks.mutants.severity import is_right_elsewhere, is_useless
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Caller, Check, References
from course.school.grading.checks.declare import declared_function
from course.school.grading.checks.mistakes import SLIPS
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import run_checks
from course.school.grading.known import KnownSubmission, trusted
from course.school.grading.references import reference

WIDTH = max(map(len, COURSE)) + 2
"""Characters of the matrix's column of modules."""

NAME = 36
"""Characters of its column of submissions."""


@dataclass(frozen=True)
class Marks:
    """What a wrong submission earned for the function that it gets wrong.

    Attributes
    ----------
    share : of the function's points
    useless : whether most of what the function gives is wrong, in its picture as well where it has one
    right_elsewhere : whether it is wrong in a corner only
    """

    share: float
    useless: bool
    right_elsewhere: bool


@dataclass(frozen=True)
class Verdict:
    """What became of one known submission.

    Attributes
    ----------
    submission : which
    failed : checks that it failed, "point_on_disk/uniform"
    told : the mistake that the student was told at the check meant for it
    fault : what is wrong with the grader; empty if nothing is
    results : of all checks, without what there was to draw
    marks : what a wrong submission earned, where all checks were run
    """

    submission: KnownSubmission
    failed: tuple[str, ...]
    told: str
    fault: str
    results: tuple[Result, ...] = ()
    marks: Marks | None = None


def judge(
    submission: KnownSubmission,
    caller: Caller,
    references: References,
    seed: int,
    only: Callable[[Check], bool] | None = None,
) -> Verdict:
    """Run all checks on a known submission and see whether they say what they should."""
    results = list(run_checks(module_checks(submission.module), caller, references, seed, only))
    wrong = [result for result in results if result.status is not Status.PASSED]
    failed = tuple(f"{result.function}/{result.check}" for result in wrong)
    meant = [
        result
        for result in wrong
        if result.function == submission.function and result.check == submission.caught_by
    ]
    told = next((result.mistake for result in meant or wrong if result.mistake), "")
    bare = tuple(replace(result, figures=()) for result in results)
    return Verdict(submission, failed, told, _fault(submission, wrong, meant), bare)


def marks(verdict: Verdict) -> Marks:
    """Those of a wrong submission, all of whose checks were run."""
    known = verdict.submission
    function = declared_function(known.module, known.function)
    own = [result for result in verdict.results if result.function == known.function]
    pictures = [result for result in own if result.kind == "picture"]
    callers = trusted(known), reference(known.module)
    shown = all(result.status is not Status.PASSED for result in pictures)
    return Marks(
        sum(result.points for result in own) / sum(result.of for result in own),
        shown and is_useless(function, *callers),
        is_right_elsewhere(function, *callers),
    )


MOST, LEAST = 0.25, 0.8
"""Shares of its points that a function of no use may earn at most, and one that is wrong in a corner earns at least."""


def unfair(found: Marks) -> str:
    """What is wrong with the points of a submission; nothing if they are fair."""
    if found.useless and found.share > MOST:
        return f"is of no use, but earns {found.share:.0%} of its points"
    if found.right_elsewhere and found.share < LEAST:
        return f"is wrong in a corner only, but earns {found.share:.0%} of its points"
    return ""


Record = dict[str, dict[str, dict[str, list[str | float]]]]
"""module -> submission -> check that it doesn't pass -> status, mistake, points earned; under "points" what every check
is worth."""


def recorded(verdicts: Iterable[Verdict]) -> Record:
    """The matrix as data."""
    found: Record = {}
    for verdict in verdicts:
        known = verdict.submission
        rows: dict[str, list[str | float]] = {}
        worth = found.setdefault(known.module, {"points": {}})["points"]
        for result in verdict.results:
            check = f"{result.function}/{result.check}"
            worth[check] = [result.of]
            if result.status is not Status.PASSED:
                rows[check] = [str(result.status), result.mistake, result.points]
        found[known.module][f"{'right' if known.right else 'wrong'}/{known.name}"] = rows
    return found


def explaining(record: Record, submissions: Iterable[KnownSubmission]) -> dict[str, list[str]]:
    """Which checks each named mistake fails: "thin_lens.point_on_disk/crowded-centre" -> names of checks."""
    found: dict[str, set[str]] = {}
    for known in submissions:
        rows = record.get(known.module, {}).get(f"wrong/{known.name}")
        if known.mistake not in ("", *SLIPS) and rows is not None:
            name = f"{known.module}.{known.function}/{known.mistake}"
            own = (check.split("/") for check in rows)
            found.setdefault(name, set()).update(
                check for function, check in own if function == known.function
            )
    return {name: sorted(checks) for name, checks in sorted(found.items())}


def changes(before: Record, after: Record) -> list[str]:
    """A line for everything that differs, of the modules that both have."""
    lines = []
    for module in (name for name in before if name in after):
        old, new = before[module], after[module]
        for name in sorted({*old, *new}):
            if name not in old or name not in new:
                lines.append(f"{module} {name}: only {'now' if name in new else 'before'}")
                continue
            for check in sorted({*old[name], *new[name]}):
                was, now = old[name].get(check), new[name].get(check)
                if was != now:
                    lines.append(f"{module} {name} {check}: {was or 'passed'} -> {now or 'passed'}")
    return lines


def _fault(submission: KnownSubmission, wrong: list[Result], meant: list[Result]) -> str:
    broken = [result for result in wrong if result.broken]
    if broken:
        return f"the grader's own error in {broken[0].id}: {broken[0].found}"
    if submission.right:
        return f"right, but fails {wrong[0].id}: {wrong[0].found}" if wrong else ""
    if not meant:
        return f"passes {submission.function}/{submission.caught_by}, which is meant for it"
    if submission.mistake and meant[0].mistake != submission.mistake:
        return f"is told {meant[0].mistake or 'nothing'!r} instead of {submission.mistake!r}"
    return ""


def matrix(verdicts: Iterable[Verdict]) -> list[str]:
    """Lines of the matrix: a submission each, the checks that it fails, the mistake that it is told."""
    lines = []
    indent = " " * (6 + WIDTH + 6)
    for verdict in verdicts:
        known = verdict.submission
        kind = "right" if known.right else "wrong"
        mark = "FAULT" if verdict.fault else "ok"
        lines.append(
            f"{mark:<6}{known.module:<{WIDTH}}{kind:<6}{known.name:<{NAME}}{', '.join(verdict.failed) or '-'}"
        )
        if verdict.told:
            lines.append(f"{indent}told: {verdict.told}")
        if verdict.fault:
            lines.append(f"{indent}{verdict.fault}")
    return lines
