"""Questions about mistakes: pictures that can be told apart, pages that tell no answer before it is opened."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.quizzes.declared import RIGHT, Asked, asked
from tests.browser import tab_to, untroubled
from tests.lengths import LONG, share

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.mistakes import figures
from sitebuild.mistakes.catalog import look
from sitebuild.mistakes.figures import Figure, draw
from sitebuild.mistakes.look import SIZE
from sitebuild.mistakes.plots import is_plot
from sitebuild.quiz.apart import Trials, block_means, described, difference
from sitebuild.quiz.asking import TRIALS, Plan, check, planned, question, titles

ASKED = [module for module in COURSE if asked(module)]

KEPT = PROJECT / "out" / "docs" / "quiz"
"""Where `course quiz` keeps figures: they are drawn once, and again when what draws them changes."""


def drawn(plan: Plan) -> dict[Figure, Image.Image]:
    """The figures of a question, drawn in this process where they aren't kept."""
    KEPT.mkdir(parents=True, exist_ok=True)
    images = {}
    for figure in plan.figures:
        path, note = (KEPT / f"{figure.key}.{suffix}" for suffix in ("webp", "txt"))
        if not (path.is_file() and note.is_file()):
            figures._drawn(figure, path, note)
        with Image.open(path) as image:
            images[figure] = image.convert("RGB")
    return images


def measured(module: str) -> Iterator[tuple[Asked, Plan]]:
    """The questions of a module whose figures are drawn here: to render them all takes minutes.

    ``make stress`` measures them all, and so does ``course quiz``. Here one rendered question of every twelfth module.
    """
    rendered = ASKED.index(module) % 12
    for each in asked(module):
        plan = planned(each)
        plotted = is_plot(look(each.path, plan.seen).draw)
        if plotted or rendered == 0 or LONG:
            yield each, plan
        rendered += not plotted


@pytest.mark.parametrize("module", share([*ASKED], 3))
def test_answers_are_told_apart_by_measurement_or_said_to_be_unseen(module: str) -> None:
    # Numbers are seeded: what passes passes always.
    for each, plan in measured(module):
        images = drawn(plan)
        found = check(plan, images)
        assert len(found) == len(plan.named) * (len(plan.named) - 1) / 2
        made = question(plan, images)
        assert plan.order[made.answer] == each.declared.mistake
        texts = [choice.text for choice in made.choices]
        assert len(set(texts)) == len(texts), each.name
        # What is read aloud describes each picture, and names no mistake.
        said = [shown.alt for shown in made.shown]
        assert len(set(said)) == len(said), each.name
        for about in (one.about for one in each.wrong.values()):
            assert not any(about in text for text in (*said, *(s.title for s in made.shown)))


def test_answers_are_at_all_places() -> None:
    plans = [planned(each) for module in COURSE for each in asked(module)]
    places = [plan.order.index(plan.asked.declared.mistake) for plan in plans]
    share = [places.count(place) / len(places) for place in range(4)]
    assert all(each > 0.15 for each in share), share


def plan_of(name: str) -> Plan:
    found = next(each for each in asked(name.partition("-")[0]) if each.name == name)
    return planned(found)


def test_a_question_whose_answers_look_alike_is_refused() -> None:
    plan = plan_of("film-01")
    images = drawn(plan)
    mistake = plan.asked.declared.mistake
    same = images | {plan.figure(mistake): images[plan.figure(RIGHT)]}
    with pytest.raises(CourseError, match="too little for the question"):
        check(plan, same)


def test_a_mistake_that_is_seen_is_not_said_to_be_unseen() -> None:
    plan = plan_of("film-04")
    assert plan.asked.declared.ask == "unseen"
    images = drawn(plan)
    other = plan.asked.declared.among[0]
    seen = images | {plan.figure(plan.asked.declared.mistake): images[plan.figure(other)]}
    with pytest.raises(CourseError, match="too much for the question"):
        check(plan, seen)


def points(rng: np.random.Generator, crowded: bool) -> Image.Image:
    """Two thousand points of the picture, or as many that crowd to its left."""
    codes = np.full((SIZE[1], SIZE[0], 3), 255, np.uint8)
    x, y = rng.random((2, 2000))
    codes[(y * SIZE[1]).astype(int), ((x**1.5 if crowded else x) * SIZE[0]).astype(int)] = 0
    return Image.fromarray(codes)


def test_other_random_numbers_make_no_difference_but_another_density_does() -> None:
    rng = np.random.default_rng(1)
    even, again, crowded = (
        [points(rng, kind) for _ in range(TRIALS)] for kind in (False, False, True)
    )
    assert difference(Trials(even), Trials(again)).alike
    assert difference(Trials(even), Trials(crowded)).apart
    # Pixel by pixel nothing tells them apart: the points are elsewhere each time.
    pixels = [block_means(each, 4) for each in (even[0], again[0], crowded[0])]
    alike, apart = (float(np.abs(pixels[0] - other).mean()) for other in pixels[1:])
    assert apart < 1.5 * alike


def test_a_difference_is_said_with_its_place() -> None:
    right = Image.new("RGB", SIZE, (100, 100, 100))
    image = right.copy()
    image.paste((200, 200, 200), (160, 0, 240, 52))
    assert described(image, right) == (
        "11% of it differs from the right one, most in the upper right part; there it is brighter."
    )
    assert described(right, right) == "It looks like the right one."


def test_another_trial_draws_with_other_numbers_in_the_same_scene() -> None:
    name, seen = "soft_shadows.point_on_sphere", 1
    usual, again, other = (
        np.asarray(draw(Figure(name, "", seen, trial)), float) for trial in (0, 0, 1)
    )
    assert np.array_equal(usual, again)
    assert not np.array_equal(usual, other)
    assert np.abs(usual - other).mean() < 1


# ---------------------------------------------------------------- the page


def quiz_of(site: Path, module: str) -> str:
    text = (site / "modules" / f"{module}.html").read_text(encoding="utf-8")
    found = re.search(r'<ol class="quiz">.*?\n</ol>', text, re.DOTALL)
    assert found, module
    return found[0]


@pytest.mark.parametrize("module", ASKED)
def test_a_page_asks_what_is_not_held_back(site: Path, module: str) -> None:
    part = quiz_of(site, module)
    shown = [each for each in asked(module) if not each.declared.held_back]
    assert part.count("<li>") == len(shown)
    plans = [planned(each) for each in shown]
    assert part.count("<details>") == sum(len(plan.order) for plan in plans)
    assert part.count("<strong>Right.</strong>") == len(shown)
    # Neither an address nor an alternative text is named after a mistake.
    pictures = re.findall(r'<img src="([^"]+)" alt="([^"]+)"', part)
    assert len(pictures) == sum(len(titles(plan)) for plan in plans)
    for address, alternative in pictures:
        assert ((site / "modules") / address).is_file()
        for plan in plans:
            for name in plan.asked.wrong:
                assert name not in address
                assert name not in alternative
    held = [each for each in asked(module) if each.declared.held_back]
    assert not any(each.name in part for each in held)


def test_an_answer_is_chosen_by_keyboard_and_without_scripts(browser: Any, site: Path) -> None:
    with untroubled(browser, java_script_enabled=True) as page:
        page.goto((site / "modules" / "film.html").as_uri())
        tab_to(page, ".quiz summary", 400)
        page.keyboard.press("Enter")
        assert page.evaluate("document.activeElement.parentElement.open")
    context = browser.new_context(offline=True, java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "modules" / "film.html").as_uri())
    answer = page.locator(".quiz details").first
    told = answer.locator("p").first
    assert not told.is_visible()
    answer.locator("summary").click()
    assert told.is_visible()
    context.close()
