"""What a class has understood: mistakes by name, failures alike without one, and what handing in again has changed."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import count
from pathlib import Path

import numpy as np
from markupsafe import Markup

from course.base.atomic import write_text
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Check, Figure, References
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import run_checks
from course.school.grading.grading import grade
from course.school.grading.known import known
from course.school.grading.references import reference, references
from course.school.grading.report import USUAL_SEED, FunctionResults, Report, ending, grouped
from course.school.grading.reports.order import place
from course.school.grading.reports.page import render

PICTURES = 12
"""Most mistakes of which the page for the lecture hall shows a picture: each is graded once."""

PANELS = 3
"""As it should be, with the mistake, and the difference; what reports enlarge below is left out."""

WORDS = {
    "Yours minus the reference": "With the mistake, minus as it should be",
    "yours minus the reference": "with the mistake, minus as it should be",
    "Yours is ": "The one with the mistake is ",
    "Yours has ": "The one with the mistake has ",
    "Yours": "With this mistake",
    "The reference": "The right one",
    "Reference": "As it should be",
    "yours": "the one with the mistake",
    "the reference": "the right one",
}
"""What reports say of a student's code and the reference, and what the page for the lecture hall says instead."""

_DRAWING = ("picture", "distribution")
"""Kinds of checks that draw something."""


@dataclass(frozen=True)
class Misconception:
    """A known mistake, and who made it.

    Attributes
    ----------
    says : what these students are told
    tried : how many students have written the function
    untried : how many haven't
    """

    module: str
    function: str
    mistake: str
    says: str
    students: tuple[str, ...]
    tried: int
    untried: int

    @property
    def share(self) -> float:
        """Of those who have written the function."""
        return len(self.students) / self.tried


@dataclass(frozen=True)
class Example:
    """The course's own submission with a mistake: what it draws beside the right one, and what its check says.

    Attributes
    ----------
    figure : ``yours`` has the mistake, ``expected`` is right; None where nothing is drawn of it
    result : of the check that is meant for the mistake; None if it passed
    """

    figure: Figure | None
    result: Result | None


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
    untried: Counter[tuple[str, str]] = Counter()
    for student, function in _functions(graded):
        if function.state == "to do":
            untried[function.module, function.name] += 1
            continue
        tried[function.module, function.name] += 1
        for result in function.others:
            if result.mistake:
                key = function.module, function.name, result.mistake
                made[key].setdefault(student, result.says)
    found = [
        Misconception(
            *key, next(iter(said.values())), tuple(said), tried[key[:2]], untried[key[:2]]
        )
        for key, said in made.items()
    ]
    return sorted(
        found, key=lambda one: (place(one.module), one.module, -len(one.students), one.mistake)
    )


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
        said = f"{first.title}: expected {first.expected or 'a value'}, found {first.found or ending(first)}"
        groups[function.module, function.name, checks].append((student, said))
    found = [
        Alike(module, name, checks, tuple(student for student, _ in members), members[0][1])
        for (module, name, checks), members in groups.items()
    ]
    return sorted(found, key=lambda one: (-len(one.students), place(one.module), one.function))


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

    Pictures and numbers are those of the course's own submissions, so nothing of a student's work is on the page.
    Raises OutputError: the file can't be written.
    """
    from course.school.grading.reports.drawing import draw, reworded, with_own_ids

    found = misconceptions(graded)
    most = sorted(found, key=lambda one: -one.share)[:PICTURES]
    examples = {one: _example(one.module, one.function, one.mistake) for one in most}
    drawings = {
        one: reworded(draw(example.figure, noisy=False), WORDS)
        for one, example in examples.items()
        if example and example.figure
    }
    plots = count(1)
    page = render(
        "lecture.html.jinja",
        graded=len(graded),
        found=found,
        modules=list(dict.fromkeys(one.module for one in found)),
        examples=examples,
        drawings={
            one: replace(drawing, panels=drawing.panels[:PANELS])
            for one, drawing in drawings.items()
        },
        pictures=PICTURES,
        unnamed=[one for one in without_name(graded) if len(one.students) > 1],
        # Made here from numbers.
        plot=lambda svg: Markup(with_own_ids(svg, f"p{next(plots)}")),
    )
    write_text(path, page)


@lru_cache(maxsize=64)
def _example(module: str, function: str, mistake: str) -> Example | None:
    """The course's example of a mistake; None if it has none."""
    one = next(
        (one for one in known(module) if (one.function, one.mistake) == (function, mistake)), None
    )
    if one is None:
        return None

    def failed(only: Callable[[Check], bool]) -> list[Result]:
        source = {module: one.source.encode()}
        report = grade(source, _references(), modules=[module], only=only)
        return [result for result in report.results if result.status is not Status.PASSED]

    meant = failed(lambda check: (check.function, check.name) == (function, one.caught_by))
    figure = _figure(meant)
    # Where that check compares numbers, one that draws may show the mistake, too.
    if figure is None:
        figure = _figure(
            failed(lambda check: check.function == function and check.kind in _DRAWING)
        )
    return Example(figure, meant[0] if meant else None)


def _figure(results: Iterable[Result]) -> Figure | None:
    """The first figure that shows what is wrong, with what is right in it; None if there is none."""
    for result in results:
        figures = [figure for figure in result.figures if figure.kind != "rays"]
        found = next(filter(_tells, _beside_right(result, figures)), None) if figures else None
        if found is not None:
            return found
    return None


def _tells(figure: Figure) -> bool:
    """Whether the two in a figure differ at all: a call whose result is right is no example of a mistake."""
    from course.school.grading.reports.drawing import are_alike

    yours, expected = (figure.arrays.get(name) for name in ("yours", "expected"))
    if yours is None or expected is None or yours.shape != expected.shape:
        return True
    if np.allclose(yours, expected, rtol=1e-5, atol=1e-5, equal_nan=True):
        return False
    # Of values that come as often as they should, only their numbers u say more.
    return figure.kind != "histogram" or "u" in figure.arrays or not are_alike(yours, expected)


def _beside_right(result: Result, figures: Sequence[Figure]) -> Iterator[Figure]:
    """The figures of a check, each with what is right beside it if that can be had."""
    if all("expected" in figure.arrays for figure in figures):
        yield from figures
        return
    right = run_checks(
        module_checks(result.module),
        reference(result.module),
        _references(),
        USUAL_SEED,
        lambda check: (check.function, check.name) == (result.function, result.check),
    )
    # Both make the same calls in the same order, as far as the one with the mistake comes.
    calls: dict[tuple[str, str], Iterator[Figure]] = {}
    drawn = [one for passed in right for one in passed.figures]
    for figure in figures:
        kind = figure.kind, figure.title
        alike = calls.setdefault(
            kind, iter([one for one in drawn if (one.kind, one.title) == kind])
        )
        one = next(alike, None)
        if one is None or "expected" in figure.arrays:
            yield figure
        else:
            yield replace(figure, arrays={**figure.arrays, "expected": one.arrays["yours"]})


@cache
def _references() -> References:
    return references()


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
