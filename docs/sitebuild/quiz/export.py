"""All that `course quiz` writes."""

import csv
from collections.abc import Sequence
from io import BytesIO, StringIO
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from course.base.errors import CourseError
from course.school.quizzes.declared import asked
from course.school.quizzes.packing import canvas, moodle, prairielearn, qti21, readme
from sitebuild.quiz.asking import check, drawn, planned, question


def contents(
    modules: Sequence[str], *, held_back: bool, kept: Path
) -> tuple[int, dict[str, bytes]]:
    """How many questions there are, and path -> content of all files.

    Parameters
    ----------
    held_back : only the questions that are on no page
    kept : folder where figures are kept from one run to the next

    Raises
    ------
    CourseError
        There is no question, one is not as it should be, or has answers that can't be told apart.
    """
    plans = [
        planned(each)
        for module in modules
        for each in asked(module)
        if each.declared.held_back or not held_back
    ]
    if not plans:
        raise CourseError(f"nobody has declared questions of {', '.join(modules)}")
    images = drawn([figure for plan in plans for figure in plan.figures], kept)
    rows = StringIO()
    table = csv.writer(rows, lineterminator="\n")
    table.writerow(("question", "one", "other", "difference", "noise", "ratio", "told apart"))
    for plan in plans:
        for pair, found in check(plan, images).items():
            numbers = (f"{each:.2f}" for each in (found.codes, found.noise, found.ratio))
            table.writerow((plan.asked.name, *pair, *numbers, "yes" if found.apart else "no"))
    questions = [question(plan, images) for plan in plans]
    return len(questions), {
        "README.md": readme(questions),
        "measured.csv": rows.getvalue().encode(),
        "canvas.zip": _zipped(canvas(questions)),
        "moodle.xml": moodle(questions),
        "qti21.zip": _zipped(qti21(questions)),
        **{f"prairielearn/questions/{k}": text for k, text in prairielearn(questions).items()},
    }


def _zipped(files: dict[str, bytes]) -> bytes:
    """A .zip file; the same questions give the same bytes."""
    made = BytesIO()
    with ZipFile(made, "w") as pack:
        for name, content in files.items():
            pack.writestr(ZipInfo(name), content, ZIP_DEFLATED)
    return made.getvalue()
