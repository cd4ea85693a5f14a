"""What a class has understood: mistakes by name, failures alike without one, and what handing in again has changed."""

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from pathlib import Path

from markupsafe import Markup

from course.atomic import write_text
from course.grading.checks.check import Figure
from course.grading.checks.result import Status
from course.grading.grading import grade
from course.grading.known import known
from course.grading.references import references
from course.grading.report import FunctionResults, Report, grouped
from course.grading.reports.page import render

PICTURES = 12
"""Most mistakes of which the page for the lecture hall shows a picture: each is graded once."""


@dataclass(frozen=True)
class Misconception:
    """A known mistake, and who made it.

    Attributes
    ----------
    says : what these students are told
    tried : how many students have written the function
    """

    module: str
    function: str
    mistake: str
    says: str
    students: tuple[str, ...]
    tried: int

    @property
    def share(self) -> float:
        """Of those who have written the function."""
        return len(self.students) / self.tried


@dataclass(frozen=True)
class Alike:
    """Students whose function fails the same checks, and makes no known mistake; the first is the example.

    Attributes
    ----------
    checks : names of the checks that fail
    said : what the most telling one says of the example: what was expected, and what came
    """

    module: str
    function: str
    checks: tuple[str, ...]
    students: tuple[str, ...]
    said: str


@dataclass(frozen=True)
class Changed:
    """What handing in again has changed: scores, and functions as "module.function"."""

    student: str
    before: float
    after: float
    mended: tuple[str, ...]
    spoilt: tuple[str, ...]


def misconceptions(graded: Sequence[Report]) -> list[Misconception]:
    """Known mistakes module by module, in each those that most make first."""
    made: dict[tuple[str, str, str], dict[str, str]] = defaultdict(dict)
    tried: Counter[tuple[str, str]] = Counter()
    for student, function in _functions(graded):
        if function.state == "to do":
            continue
        tried[function.module, function.name] += 1
        for result in function.others:
            if result.mistake:
                key = function.module, function.name, result.mistake
                made[key].setdefault(student, result.says)
    found = [
        Misconception(*key, next(iter(said.values())), tuple(said), tried[key[:2]])
        for key, said in made.items()
    ]
    order = list(dict.fromkeys(module for module, _ in tried))
    return sorted(found, key=lambda one: (order.index(one.module), -len(one.students), one.mistake))


def without_name(graded: Sequence[Report]) -> list[Alike]:
    """Wrong functions that make no known mistake, grouped by the checks that they fail; large groups first."""
    groups: dict[tuple[str, str, tuple[str, ...]], list[tuple[str, str]]] = defaultdict(list)
    for student, function in _functions(graded):
        if function.state != "wrong" or any(result.mistake for result in function.others):
            continue
        # A file that can't be used says nothing of a function; it is among the remarks.
        if function.results[0].module_wide:
            continue
        checks = tuple(result.check for result in function.others)
        first = (function.told or function.others)[0]
        said = f"{first.title}: expected {first.expected or 'a value'}, found {first.found}"
        groups[function.module, function.name, checks].append((student, said))
    found = [
        Alike(module, name, checks, tuple(student for student, _ in members), members[0][1])
        for (module, name, checks), members in groups.items()
    ]
    return sorted(found, key=lambda one: (-len(one.students), one.module, one.function))


def changes(earlier: Mapping[str, Report], graded: Sequence[Report]) -> list[Changed]:
    """Of students who were graded before, whose functions have another state now."""
    found = []
    for report in graded:
        before = earlier.get(report.student)
        if before is None or before.trouble:
            continue
        then, now = _states(before), _states(report)
        differ = [name for name in now if name in then and then[name] != now[name]]
        if differ:
            mended = tuple(name for name in differ if now[name] == "right")
            spoilt = tuple(name for name in differ if then[name] == "right")
            found.append(Changed(report.student, before.score, report.score, mended, spoilt))
    return sorted(found, key=lambda one: (one.after - one.before, one.student))


def write_lecture_page(graded: Sequence[Report], path: Path) -> None:
    """Write what can be shown in the lecture hall: mistakes, shares and pictures, and nobody's name.

    Pictures are those of the course's own wrong submissions, so nothing of a student's work is on the page.
    Raises OutputError: the file can't be written.
    """
    from course.grading.reports.drawing import draw, with_own_ids

    found = misconceptions(graded)
    most = sorted(found, key=lambda one: -one.share)[:PICTURES]
    plots = count(1)
    page = render(
        "lecture.html.jinja",
        graded=len(graded),
        found=found,
        figures={
            one: draw(figure)
            for one in most
            if (figure := _figure(one.module, one.function, one.mistake)) is not None
        },
        unnamed=[one for one in without_name(graded) if len(one.students) > 1],
        # Made here from numbers.
        plot=lambda svg: Markup(with_own_ids(svg, f"p{next(plots)}")),
    )
    write_text(path, page)


@lru_cache(maxsize=64)
def _figure(module: str, function: str, mistake: str) -> Figure | None:
    """What the check that is meant for a mistake draws of it; None if that is nothing."""
    one = next(
        (one for one in known(module) if (one.function, one.mistake) == (function, mistake)), None
    )
    if one is None:
        return None
    report = grade(
        {module: one.source.encode()},
        references(),
        modules=[module],
        only=lambda check: (check.function, check.name) == (function, one.caught_by),
    )
    drawn = (figure for result in report.results for figure in result.figures)
    return next((figure for figure in drawn if figure.kind != "rays"), None)


def _functions(graded: Sequence[Report]) -> list[tuple[str, FunctionResults]]:
    return [
        (report.student, function)
        for report in graded
        for module in grouped(report)
        for function in module.functions
    ]


def _states(report: Report) -> dict[str, str]:
    return {
        f"{function.module}.{function.name}": function.state
        for _, function in _functions([report])
        if any(result.status is not Status.GRADER_ERROR for result in function.results)
    }
