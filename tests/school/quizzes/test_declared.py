"""Declared questions: enough of them, about submissions that are there, and nowhere in what students get."""

from pathlib import Path

import pytest

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, MODULES
from course.school.grading.release.archive import PAGES, SCENES, project_files, solution_lines
from course.school.quizzes.declared import asked

SOLUTIONS = PROJECT / "solutions"


ASKED = [module for module in COURSE if asked(module)]


def test_the_core_modules_have_questions_and_most_of_the_others() -> None:
    assert set(MODULES) <= set(ASKED)
    assert len(ASKED) >= 17


@pytest.mark.parametrize("module", ASKED)
def test_each_module_asks_on_its_page_and_holds_some_back(module: str) -> None:
    found = asked(module)
    assert sum(not each.declared.held_back for each in found) >= 4
    assert any(each.declared.held_back for each in found)
    assert {each.declared.ask for each in found} >= {"which"}
    assert len({each.name for each in found}) == len(found)


def test_there_are_at_least_sixty_on_the_pages_of_all_kinds() -> None:
    found = [each for module in COURSE for each in asked(module) if not each.declared.held_back]
    assert len(found) >= 60
    kinds = [each.declared.ask for each in found]
    assert all(kinds.count(kind) >= 15 for kind in ("which", "predict", "unseen"))


QUESTION = """
- ask: which
  function: expose
  mistake: expose_natural
  among: [expose_linear, expose_added]
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("expose_linear", "expose_none", "question 1: expose has no wrong submission expose_none"),
        ("expose_linear", "luminance_max", "expose has no wrong submission luminance_max"),
        ("expose_linear", "expose_natural", "question 1: an answer is there twice"),
        ("expose_linear", "right", "only a picture to be predicted may be the right one"),
        ("[expose_linear, expose_added]", "[expose_linear]", "length >= 2"),
        ("ask: which", "ask: unseen", "`why` is for a mistake that is unseen"),
        ("ask: which", "ask: why", "Invalid enum value 'why'"),
        ("ask: which", "ask: which\n  hint: no", "unknown field `hint`"),
    ],
)
def test_what_is_declared_wrongly_is_refused(tmp_path: Path, old: str, new: str, said: str) -> None:
    (tmp_path / "quizzes").mkdir()
    for name in ("film.py", "wrong", "right"):
        (tmp_path / name).symlink_to(SOLUTIONS / name)
    path = tmp_path / "quizzes" / "film.yaml"
    path.write_text(QUESTION, encoding="utf-8")
    assert asked("film", tmp_path)[0].name == "film-01"
    path.write_text(QUESTION.replace(old, new), encoding="utf-8")
    with pytest.raises(CourseError, match=r"film\.yaml") as refused:
        asked("film", tmp_path)
    assert said in str(refused.value)


def test_no_question_is_in_what_students_get() -> None:
    lines = solution_lines(SOLUTIONS)
    for path in (SOLUTIONS / "quizzes").iterdir():
        longest = max(path.read_text(encoding="utf-8").splitlines(), key=len)
        assert longest.strip() in lines
    for name, content in project_files(PROJECT, (), SCENES | PAGES).items():
        rows = {row.strip() for row in content.decode("utf-8", "replace").splitlines()}
        assert not rows & lines, name
