"""`course viva`: questions whose answers were found by making the change, in the worker."""

import os

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.checks.check import References
from course.school.grading.reports.viva import drawings, viva_page
from course.school.grading.viva.asking import VivaQuestion, viva
from course.school.grading.worker.sandbox import plain

SOLUTIONS = PROJECT / "solutions"


def source(module: str) -> str:
    return (SOLUTIONS / f"{module}.py").read_text(encoding="utf-8")


def asked(
    sources: dict[str, str], references: References, questions: int = 3
) -> list[VivaQuestion]:
    encoded = {module: text.encode() for module, text in sources.items()}
    return list(viva(encoded, SOLUTIONS, references, plain(), questions=questions))


@pytest.fixture(scope="module")
def two(usual_references: References) -> list[VivaQuestion]:
    return asked(
        {"soft_shadows": source("soft_shadows"), "motion_blur": source("motion_blur")},
        usual_references,
        2,
    )


def test_questions_are_about_different_modules_and_the_students_lines(
    two: list[VivaQuestion],
) -> None:
    assert {one.module for one in two} == {"soft_shadows", "motion_blur"}
    for one in two:
        lines = source(one.module).splitlines()
        assert lines[one.change.line - 1].strip() == one.change.before
        assert one.change.function in COURSE[one.module]
        assert f"line {one.change.line} of `{one.module}.py`" in one.asks


def test_an_answer_shows_what_the_change_does(two: list[VivaQuestion]) -> None:
    for one in two:
        answer = one.answer
        assert answer.visible
        assert answer.before is not None
        assert answer.after is not None
        own, changed = (each.arrays["yours"] for each in (answer.before, answer.after))
        assert abs(own - changed).max() > 0.01
        assert any("fails its check" in said for said in one.told)
        (drawing,) = drawings(answer)
        assert [panel.title for panel in drawing.panels][:2] == ["As it is", "Changed"]
        said = " ".join(f"{panel.alt} {panel.caption}" for panel in drawing.panels)
        assert "reference" not in said.lower()


def test_the_same_code_gets_the_same_questions(
    two: list[VivaQuestion], usual_references: References
) -> None:
    (again,) = asked({two[0].module: source(two[0].module)}, usual_references, 1)
    assert again.module == two[0].module


def test_the_page_folds_its_answers_away(two: list[VivaQuestion]) -> None:
    page = viva_page("Ada <script>", two, "")
    assert "Ada &lt;script&gt;" in page
    body, *answers = page.split("<details")
    assert len(answers) == len(two)
    assert "fails its check" not in body


def test_a_function_that_is_wrong_is_not_asked_about(usual_references: References) -> None:
    wrong = (
        source("motion_blur") + "\ndef shutter_times(u, open, close):\n    return open + 0 * u\n"
    )
    names = {one.change.function for one in asked({"motion_blur": wrong}, usual_references)}
    assert names <= {"displacement", "to_object_space"}


def test_the_code_never_runs_in_the_graders_process(usual_references: References) -> None:
    spy = source("motion_blur") + f"\nimport os\nassert os.getpid() != {os.getpid()}\n"
    assert asked({"motion_blur": spy}, usual_references, 1)


@pytest.mark.parametrize(
    "text", ["x = " + "-" * 50_000 + "1\n", "def f(): return 1" + " + 1" * 50_000]
)
def test_a_text_that_can_t_be_taken_apart_costs_its_own_module(
    usual_references: References, text: str
) -> None:
    sources = {"soft_shadows": source("soft_shadows") + text, "motion_blur": source("motion_blur")}
    assert {one.module for one in asked(sources, usual_references, 1)} == {"motion_blur"}
