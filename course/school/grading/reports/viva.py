"""The page of `course viva`: questions, and answers that are folded away."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import count

from markupsafe import Markup

from course.school.grading.checks.check import Figure
from course.school.grading.reports.drawing import Drawing, draw, reworded, with_own_ids
from course.school.grading.reports.page import render
from course.school.grading.viva.asking import Answer, VivaQuestion

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


def viva_page(student: str, asked: Sequence[VivaQuestion], unprotected: str) -> str:
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
    drawn = reworded(draw(Figure(after.kind, after.title, both), noisy=False), WORDS)
    return [replace(drawn, panels=drawn.panels[:PANELS])]
