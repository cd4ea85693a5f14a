"""Choose questions about a student's code: changes whose effect can be shown, found by making them.

The student's code runs where all of it does, in a worker (`course.school.grading.worker`). Only functions that are
right are asked about, so that what a change does is the change's doing. Of each function some changes are tried, and
the one whose effect says most is kept.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from random import Random

from course.engine.functions.modules import COURSE
from course.school.grading.checks.check import Figure, References
from course.school.grading.checks.result import Result, Status
from course.school.grading.classes.engines import apart
from course.school.grading.grading import grade
from course.school.grading.pictures.catalog import SCENES
from course.school.grading.release.stubs import make_stub
from course.school.grading.report import FunctionResults, grouped
from course.school.grading.viva.changes import SourceChange, changes
from course.school.grading.worker.sandbox import Sandbox

TRIED = 6
"""Changes of one function that are tried at most."""

LARGEST, MOST = 200_000, 1000
"""Characters of a text that is looked through, and changes of all its functions."""

TOLD = 3
"""Failed checks that an answer names at most."""

SLOW = ("order", "speed", "bias", "whole")
"""Kinds of checks that take long, and show nothing that is drawn."""


@dataclass(frozen=True)
class Answer:
    """What a change does.

    Attributes
    ----------
    before, after : what is drawn of the student's code and of the changed one; None if nothing is
    visible : whether the check fails that it is drawn for
    checks : results of checks that fail, the most telling first
    says : what a student is told who makes this mistake; empty where it has no name
    """

    before: Figure | None
    after: Figure | None
    visible: bool
    checks: tuple[Result, ...]
    says: str

    @property
    def worth(self) -> int:
        """How much there is to talk about."""
        drawn = self.after is not None
        return 4 * (self.visible and drawn) + 2 * drawn + bool(self.says)


@dataclass(frozen=True)
class VivaQuestion:
    """One question about one line, with its answer."""

    module: str
    change: SourceChange
    answer: Answer

    @property
    def file(self) -> str:
        """The student's file."""
        return f"{self.module}.py"

    @property
    def asks(self) -> str:
        """The question; the line before and after the change stands below it."""
        what = "would the picture show with" if _is_pictures(self.answer.after) else "comes of"
        return f"What {what} this change in line {self.change.line} of `{self.file}`?"

    @property
    def told(self) -> Iterator[str]:
        """The answer in sentences, without its figures."""
        answer = self.answer
        if _is_pictures(answer.after):
            yield (
                "The picture differs from the student's own, and fails its check."
                if answer.visible
                else "The picture can hardly be told from the student's own."
            )
        if answer.says:
            yield f"It is a mistake that is known: {answer.says}"
        for result in answer.checks:
            found = f"expected {result.expected}, found {result.found}" if result.expected else ""
            yield f"{result.check}: {result.title}: {found or result.found}"


def _listed(work: tuple[str, str, str, str]) -> list[SourceChange]:
    """Changes of one function of a student's text; in another process, for a text can be made to take hours."""
    source, module, function, given = work
    if len(source) > LARGEST:
        return []
    found = islice(changes(source, COURSE[module], given), MOST)
    return [one for one in found if one.function == function]


def _is_pictures(figure: Figure | None) -> bool:
    return figure is not None and figure.kind == "pictures"


def viva(
    sources: Mapping[str, bytes],
    solutions: Path,
    references: References,
    shut_in: Sandbox,
    *,
    questions: int = 3,
    seed: int = 0,
    each: Callable[[str], None] = lambda _: None,
) -> Iterator[VivaQuestion]:
    """Questions about as many functions, of different modules as far as there are.

    Parameters
    ----------
    sources : module -> the student's file
    solutions : the folder, for the stubs whose lines are not the student's
    references : arrays that checks compare with
    shut_in : how workers are started
    seed : other questions for the same code
    each : called with "module.function" when it is being tried
    """
    rng = Random(f"{seed} {sorted(sources)}")
    left = questions
    for module, function in _functions(sources, rng):
        if left == 0:
            return
        source = sources[module].decode("utf-8", "replace")
        given = make_stub(
            (solutions / f"{module}.py").read_text(encoding="utf-8"), module, f"{module}.py"
        ).text
        (found,) = apart(_listed, [(source, module, function, given)]).values()
        if not found:
            continue
        each(f"{module}.{function}")

        def graded(text: str, module: str = module, function: str = function) -> FunctionResults:
            report = grade(
                {module: text.encode()},
                references,
                modules=(module,),
                only=lambda check: check.function == function and check.kind not in SLOW,
                shut_in=shut_in,
            )
            return grouped(report)[0].functions[0]

        own = graded(source)
        if own.state != "right":
            continue
        best = _best(own, _varied(found, rng), graded)
        if best is not None:
            left -= 1
            yield VivaQuestion(module, *best)


def _functions(sources: Mapping[str, bytes], rng: Random) -> list[tuple[str, str]]:
    """By chance, with one function of each module before the second of any, and those with a picture before others."""
    by_module = [[(module, name) for name in COURSE[module]] for module in sources]
    for one in by_module:
        rng.shuffle(one)
        one.sort(key=lambda pair: ".".join(pair) not in SCENES)
    rng.shuffle(by_module)
    longest = max(map(len, by_module), default=0)
    return [one[number] for number in range(longest) for one in by_module if number < len(one)]


def _varied(found: list[SourceChange], rng: Random) -> list[SourceChange]:
    """Some changes by chance, of as many kinds and lines as there are."""
    rng.shuffle(found)
    seen: dict[str, int] = {}
    ranked = []
    for one in found:
        ranked.append((seen.get(one.kind, 0), one))
        seen[one.kind] = seen.get(one.kind, 0) + 1
    return [one for _, one in sorted(ranked, key=lambda pair: pair[0])][:TRIED]


def _best(
    own: FunctionResults, found: list[SourceChange], graded: Callable[[str], FunctionResults]
) -> tuple[SourceChange, Answer] | None:
    """The change with most to talk about; the first that is good enough ends the search."""
    best: tuple[SourceChange, Answer] | None = None
    for change in found:
        answer = _answer(own, graded(change.source))
        if answer is None:
            continue
        if best is None or answer.worth > best[1].worth:
            best = change, answer
        if answer.visible and answer.after is not None:
            break
    return best


def _answer(own: FunctionResults, changed: FunctionResults) -> Answer | None:
    """What has come of it; None if nothing has, or nothing that is more than an error."""
    failed = changed.told
    if not failed or any(
        result.status is not Status.FAILED or result.module_wide for result in changed.others
    ):
        return None
    before = {result.check: result for result in own.results}
    pictures = [result for result in changed.results if result.kind == "picture"]
    shown = [*pictures, *failed]
    drawn = next(
        (
            (_pair(before[result.check], result), result.status is Status.FAILED)
            for result in shown
            if before[result.check].figures and result.figures
        ),
        ((None, None), False),
    )
    (was, now), visible = drawn
    says = next((result.says for result in failed if result.says), "")
    checks = tuple(result for result in failed if result.kind != "picture")[:TOLD]
    return Answer(was, now, visible, checks, says)


def _pair(own: Result, changed: Result) -> tuple[Figure, Figure]:
    """The student's figure, and that of the changed code."""
    return own.figures[0], changed.figures[0]
