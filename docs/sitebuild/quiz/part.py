"""The quiz of a module's page. To choose an answer is to open it, so it needs no script."""

from collections.abc import Mapping
from html import escape
from pathlib import Path

from PIL import Image

from course.school.quizzes.declared import asked
from course.school.quizzes.packing import marked
from course.school.quizzes.question import LETTERS, Question
from sitebuild.mistakes.catalog import look
from sitebuild.mistakes.figures import STUDIO, Figure, blank
from sitebuild.mistakes.look import SIZE
from sitebuild.mistakes.plots import is_plot
from sitebuild.place import Place
from sitebuild.quiz.asking import Plan, planned, question, titles

HEADING = "Quiz"


def has_questions(module: str) -> bool:
    """True if somebody has declared questions of a module."""
    return bool(asked(module))


def quiz(place: Place, name: str, words: str = "") -> str:  # noqa: ARG001
    """Ask the questions of a module that aren't held back.

    Raises
    ------
    CourseError
        Its questions are not as they should be.
    """
    plans = [planned(each) for each in asked(name) if not each.declared.held_back]
    figures = [plan.figure(each) for plan in plans for each in plan.named]
    if place.blank:
        files = {each: blank(each, place.made / "mistakes") for each in figures}
    else:
        files = {each: file for each, (file, _) in STUDIO.files(dict.fromkeys(figures)).items()}
    images = {each: _opened(file) for each, file in files.items()}
    parts = [
        f"{len(plans)} questions about mistakes that others have made. Decide first, then open your answer.\n",
        '<ol class="quiz">',
    ]
    parts += [_asked(plan, question(plan, images), place, files) for plan in plans]
    return "\n".join([*parts, "</ol>\n"])


def _opened(file: Path) -> Image.Image:
    with Image.open(file) as image:
        return image.convert("RGB")


def _asked(plan: Plan, asked: Question, place: Place, files: Mapping[Figure, Path]) -> str:
    """One question; a line of HTML begins no paragraph of Markdown."""
    kind = "plot" if is_plot(look(plan.asked.path, plan.seen).draw) else "picture"
    choices = [_choice(asked, number) for number in range(len(asked.choices))]
    pictures = plan.asked.declared.ask == "predict"
    figures = []
    for number, ((title, name), shown) in enumerate(zip(titles(plan), asked.shown, strict=True)):
        file = files[plan.figure(name)]
        # The address must not tell the answer.
        address = place.address(f"_quiz/{asked.name}-{number + 1}.webp", file)
        width, height = SIZE
        image = (
            f'<img src="{address}" alt="{escape(shown.alt)}" width="{width}" height="{height}" '
            'loading="lazy">'
        )
        caption = choices[number] if pictures else escape(title)
        figures.append(f'<figure class="{kind}">{image}<figcaption>{caption}</figcaption></figure>')
    lines = ["<li>", *(f"<p>{marked(text)}</p>" for text in asked.asks)]
    lines += ['<div class="shown">', *figures, "</div>"]
    lines += [] if pictures else choices
    return "\n".join([*lines, "</li>"])


def _choice(asked: Question, number: int) -> str:
    choice = asked.choices[number]
    if number == asked.answer:
        told = f'<p class="right"><strong>Right.</strong> {marked(asked.explained)}</p>'
    else:
        told = f"<p><strong>No.</strong> {marked(choice.told)}</p>"
    letter = "" if choice.text.startswith("Picture ") else f"{LETTERS[number]}. "
    return f"<details><summary>{letter}{marked(choice.text)}</summary>{told}</details>"
