"""What the engine in a student's archive answers is what the page says, and a submission can't call it."""

import re
from pathlib import Path

import pytest

from course.engine.functions.modules import COURSE
from course.school.grading.checks.check import References
from course.school.grading.grading import grade
from course.school.grading.references import references
from course.school.grading.release.archive import FOLDERS
from tests.school.grading.release.engine_answers import ANSWERS, PROJECT, RETYPED, copied

PAGE = Path(__file__).parents[4] / "docs" / "grading.md"


def test_the_page_names_each_function_and_its_answer() -> None:
    text = PAGE.read_text("utf-8").partition("<!-- engine: begin -->")[2]
    rows = re.findall(r"^\| `(\S+\.\S+)` \| (.*) in `(\S+)` \|$", text, re.MULTILINE)
    told = {name: (tuple(re.findall(r"`(\w+)`", names)), file) for name, names, file in rows}
    assert told == {name: (one.names, one.file) for name, one in ANSWERS.items()}
    assert f"answers {len(ANSWERS)} functions" in PAGE.read_text("utf-8")
    # Modules that are said to have none have none.
    free = re.findall(
        r"`(\w+)`",
        PAGE.read_text("utf-8").partition("modules that have none\n")[2].partition(").")[0],
    )
    answered = {name.partition(".")[0] for name in ANSWERS | RETYPED}
    assert {*free} == {*COURSE} - answered


def test_the_page_names_what_can_be_retyped() -> None:
    text = PAGE.read_text("utf-8").partition("<!-- retyped: begin -->")[2]
    text = text.partition("<!-- retyped: end -->")[0]
    told = {
        f"{module}.{function}": (name, file)
        for module, functions, name, file in re.findall(
            r"^\| `(\w+)`: (.*) \| `(\w+)` in `(\S+)` \|$", text, re.MULTILINE
        )
        for function in re.findall(r"`(\w+)`", functions)
    }
    assert told == RETYPED
    assert f"forms of {len(RETYPED)} others" in PAGE.read_text("utf-8")
    for name, file in RETYPED.values():
        assert re.search(rf"^def {name}\(", (PROJECT / file).read_text("utf-8"), re.MULTILINE), name


@pytest.mark.parametrize("name", ANSWERS)
def test_it_is_worth_what_the_page_says(name: str, usual_references: References) -> None:
    answer = ANSWERS[name]
    assert answer.file.partition("/")[0] in FOLDERS
    module, _, function = name.partition(".")
    report = grade(
        {module: copied(answer).encode()},
        usual_references,
        modules=[module],
        only=lambda check: check.function == function,
    )
    assert report.points >= 0.7 * report.of > 0


def test_a_submission_that_imports_the_engine_is_not_imported() -> None:
    source = "from course.engine.core.fresnel_refraction import fresnel_and_cos_t\n"
    report = grade(
        {"blurred_transparency": source.encode()}, references(), modules=["blurred_transparency"]
    )
    assert report.points == 0
    assert "can't be imported" in report.results[0].found
