"""What docs/teaching.yaml declares for those who teach is what the course has: modules, checks, an order that works."""

import math

import pytest

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.objectives import objectives
from sitebuild.parts import Site
from sitebuild.place import Place
from sitebuild.plans import plan
from sitebuild.teaching_file import WORDS_PER_MINUTE, minutes, reading_minutes, teaching

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, MODULES
from course.school.grading.catalog import module_checks
from tests.docs.test_sitebuild import _app

DECLARED = teaching().modules

UNSEEN = ("understand", "know", "learn", "appreciate", "be", "have", "realise")
"""Verbs of what no check can see."""


def test_every_module_is_declared_in_the_courses_order() -> None:
    order = ["sampling", *(module for module in COURSE if module != "sampling")]
    assert list(DECLARED) == order


@pytest.mark.parametrize("module", COURSE)
def test_every_objective_names_checks_that_there_are(module: str) -> None:
    names = {f"{check.function}/{check.name}" for check in module_checks(module).checks}
    for objective in DECLARED[module].objectives:
        assert set(objective.shown_by) <= names, objective.can
        assert len(set(objective.shown_by)) == len(objective.shown_by), objective.can
        assert objective.can.split()[0] not in UNSEEN, objective.can


@pytest.mark.parametrize("module", COURSE)
def test_no_objective_rests_on_checks_that_take_no_points(module: str) -> None:
    """Nor on those that every function has, whatever it does."""
    every = {f"{check.function}/{check.name}": check for check in module_checks(module).checks}
    for objective in DECLARED[module].objectives:
        for name in objective.shown_by:
            assert every[name].points > 0, name
            assert every[name].kind not in ("contract", "speed"), name


@pytest.mark.parametrize("module", COURSE)
def test_every_function_serves_an_objective(module: str) -> None:
    served = {name for each in DECLARED[module].objectives for name in each.functions}
    assert served == set(COURSE[module])


def test_what_a_module_builds_on_comes_before_it() -> None:
    """So nothing builds on itself, by whatever way around."""
    seen: set[str] = set()
    for module, declared in DECLARED.items():
        assert set(declared.needs) <= seen, module
        seen.add(module)


@pytest.mark.parametrize(("name", "weeks"), [("six weeks", 6), ("twelve weeks", 12)])
def test_a_plan_takes_what_a_module_builds_on_no_later_than_it(name: str, weeks: int) -> None:
    planned = teaching().plans[name]
    assert len(planned) == weeks
    modules = [module for week in planned for module in week.modules]
    assert len(set(modules)) == len(modules)
    assert set(MODULES) <= set(modules) <= set(COURSE)
    for place, module in enumerate(modules):
        assert set(DECLARED[module].needs) <= set(modules[:place]), module


def test_the_long_plan_has_the_whole_course() -> None:
    planned = {module for week in teaching().plans["twelve weeks"] for module in week.modules}
    assert planned == set(COURSE)


def test_the_time_to_read_counts_words_and_no_code() -> None:
    words = "word " * (6 * WORDS_PER_MINUTE)
    assert reading_minutes(words) == 10
    assert reading_minutes("word " * (5 * WORDS_PER_MINUTE)) == 5
    code = "\n\n    command\n\n```python\n" + "word " * 10_000 + "\n```\n<!-- site: " + "x " * 9_999
    assert reading_minutes(words + code + "-->\n") == 10
    assert reading_minutes(words + "$x + y$ " * WORDS_PER_MINUTE) == 10
    assert reading_minutes(words + "[a](b/c/d/e/f) " * (4 * WORDS_PER_MINUTE)) == 10


def _place(folder: object) -> Place:
    return Place(up="../", blank=True, made=folder, files={})  # type: ignore[arg-type]


@pytest.mark.parametrize("module", COURSE)
def test_a_page_begins_with_its_objectives(module: str, tmp_path: object) -> None:
    text = (PROJECT / "docs" / "modules" / f"{module}.md").read_text(encoding="utf-8")
    # Pictures and plots are other parts' work.
    short = text.partition("\n## The phenomenon\n")[0] + "\n## The phenomenon\n"
    expanded = Site(_app(tmp_path)).expanded(f"modules/{module}", short)  # type: ignore[arg-type]
    before = expanded.partition("\n## The phenomenon\n")[0]
    reading, writing, rendering = minutes(module)
    for objective in DECLARED[module].objectives:
        assert objective.can[1:] in before
        for function in objective.functions:
            assert f"[{function}](#{function})" in before
            assert f"\n## {function}\n" in text
    assert f"{reading} minutes to read, about {writing} to write (an estimate)" in before
    assert f"{rendering} to render" in before
    lead, task = before.partition("**To write**")[::2]
    assert len(lead) < 1000
    task = task.partition("\n")[0]
    assert all(f"[{function}](#{function})" in task for function in COURSE[module])
    assert f"`course check {module}`" in task


def test_all_objectives_are_listed_with_their_checks(tmp_path: object) -> None:
    listed = objectives(_place(tmp_path), "")
    for declared in DECLARED.values():
        for objective in declared.objectives:
            row = next(line for line in listed.splitlines() if objective.can[1:] in line)
            assert all(f"`{check}`" in row for check in objective.shown_by)


def test_the_hours_of_a_week_are_those_of_its_modules(tmp_path: object) -> None:
    rows = plan(_place(tmp_path), "six", "weeks").splitlines()[2:]
    for week, row in zip(teaching().plans["six weeks"], rows, strict=True):
        hours = sum(sum(minutes(module)) for module in week.modules) / 60
        assert math.isclose(float(row.split("|")[-2]), hours, abs_tol=0.051)
