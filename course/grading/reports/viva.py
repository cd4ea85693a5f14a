"""The page of `course viva`: questions, and answers that are folded away."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import count

from markupsafe import Markup

from course.grading.checks.check import Figure
from course.grading.reports.drawing import Drawing, Panel, draw, with_own_ids
from course.grading.reports.page import render
from course.grading.viva.asking import Answer, Asked

WORDS = {
    "Yours minus the reference": "The changed code's minus the student's own",
    "yours minus the reference": "the changed code's minus the student's own",
    "Yours": "Changed",
    "The reference": "As it is",
    "Reference": "As it is",
    "yours": "the changed one",
    "the reference": "the student's own",
}
"""What reports say of a student's code and the reference, and what is said here in its place."""

PANELS = 3
"""Before, after, and the difference; what reports enlarge below is left out."""


def viva_page(student: str, asked: Sequence[Asked], unprotected: str) -> str:
    """HTML of the questions to one student.

    ``unprotected``: the harm that the code could have done, as `Report.unprotected` says it; empty if none
    """
    plots = count(1)
    return render(
        "viva.html.jinja",
        student=student,
        asked=asked,
        drawings=[drawings(one.answer) for one in asked],
        unprotected=unprotected,
        # Made here from numbers: nothing of a student's text is in it.
        plot=lambda svg: Markup(with_own_ids(svg, f"p{next(plots)}")),
    )


def drawings(answer: Answer) -> list[Drawing]:
    """What is seen of the code as it is, and of the changed code."""
    before, after = answer.before, answer.after
    if before is None or after is None:
        return []
    both = {"yours": after.arrays["yours"], "expected": before.arrays["yours"]}
    if after.kind == "histogram":
        pair = (("As it is", before), ("Changed", after))
        return [_titled(_yours(figure), title) for title, figure in pair]
    drawn = draw(Figure(after.kind, after.title, both))
    notes = tuple(_said(note) for note in drawn.notes)
    return [replace(drawn, panels=tuple(map(_renamed, drawn.panels[:PANELS])), notes=notes)]


def _yours(figure: Figure) -> Drawing:
    return draw(Figure(figure.kind, figure.title, {"yours": figure.arrays["yours"]}))


def _titled(drawing: Drawing, title: str) -> Drawing:
    return replace(
        drawing, panels=tuple(replace(_renamed(one), title=title) for one in drawing.panels)
    )


def _renamed(panel: Panel) -> Panel:
    return replace(
        panel, title=_said(panel.title), alt=_said(panel.alt), caption=_said(panel.caption)
    )


def _said(text: str) -> str:
    for old, new in WORDS.items():
        text = text.replace(old, new)
    return text
