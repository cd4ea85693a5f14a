"""Answers to the exercises and the questions for exams: numbers are right, and students find none of them."""

import math
import re
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.release.archive import PAGES, SCENES, project_files, solution_lines

ANSWERS = PROJECT / "solutions" / "answers"
EXAMS = PROJECT / "solutions" / "exams"


def numbers(text: str) -> list[int]:
    return [int(number) for number in re.findall(r"^(\d+)\. ", text, re.MULTILINE)]


ANSWERED = sorted(path.stem for path in ANSWERS.iterdir())


def test_each_module_has_answers() -> None:
    assert set(ANSWERED) == set(COURSE)


@pytest.mark.parametrize("module", ANSWERED)
def test_there_is_an_answer_for_each_exercise(module: str) -> None:
    page = (PROJECT / "docs" / "modules" / f"{module}.md").read_text(encoding="utf-8")
    exercises = page.partition("\n## Exercises\n")[2].partition("\n## ")[0]
    answers = (ANSWERS / f"{module}.md").read_text(encoding="utf-8")
    assert numbers(answers) == numbers(exercises) != []


def test_the_archive_is_searched_for_lines_of_answers() -> None:
    lines = solution_lines(PROJECT / "solutions")
    for path in (*ANSWERS.iterdir(), *EXAMS.iterdir()):
        answer = max(path.read_text(encoding="utf-8").splitlines(), key=len)
        assert answer.strip() in lines


def test_nothing_that_students_get_has_a_line_of_an_answer() -> None:
    lines = solution_lines(PROJECT / "solutions")
    for name, content in project_files(PROJECT, (), SCENES | PAGES).items():
        assert not name.startswith("solutions")
        rows = {row.strip() for row in content.decode("utf-8", "replace").splitlines()}
        assert not rows & lines, name


@pytest.mark.parametrize("module", COURSE)
def test_exams_have_questions_with_answers(module: str) -> None:
    text = (EXAMS / f"{module}.md").read_text(encoding="utf-8")
    questions = re.split(r"^(?=\d+\. )", text, flags=re.MULTILINE)[1:]
    assert numbers(text) == [*range(1, len(questions) + 1)]
    assert len(questions) >= 3
    for question in questions:
        assert re.match(
            r"\d+\. \(\d+ points, \d+ minutes\) .*\n\n   \*Answer\.\* ", question, re.DOTALL
        )


@pytest.mark.parametrize(
    "page", [*ANSWERS.iterdir(), *EXAMS.iterdir()], ids=lambda page: page.parent.name + page.stem
)
def test_numbers_of_answers_are_right(page: Path) -> None:
    for holds in re.findall(r"<!-- holds: (.*?) -->", page.read_text(encoding="utf-8")):
        assert eval(holds, vars(math).copy()), holds
