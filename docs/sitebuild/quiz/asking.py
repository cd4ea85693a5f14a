"""Questions from what is declared: texts from the submissions, pictures as the mistakes' figures are drawn."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from itertools import combinations
from pathlib import Path
from random import Random

from PIL import Image

from course.base.errors import CourseError
from course.school.grading.checks.declare import declared_function
from course.school.quizzes.declared import RIGHT, Asked
from course.school.quizzes.question import LETTERS, Choice, Question, ShownPicture
from sitebuild.mistakes.catalog import look, look_at
from sitebuild.mistakes.figures import STUDIO, Figure
from sitebuild.quiz.apart import Difference, Trials, described, difference

TRIALS = 3
"""Drawings of a figure that random numbers have a say in."""


@dataclass(frozen=True)
class Plan:
    """A question and the figures that it needs.

    Attributes
    ----------
    asked : as declared
    seen : number of the look
    order : names of the answers as they are shown; "right" is the right function
    """

    asked: Asked
    seen: int
    order: tuple[str, ...]

    @property
    def shows(self) -> str:
        """What one sees in its pictures."""
        return look(self.asked.path, self.seen).shows

    @cached_property
    def named(self) -> tuple[str, ...]:
        """All that is drawn: the answers, and the right function."""
        return tuple(dict.fromkeys((RIGHT, *self.order)))

    def figure(self, name: str, trial: int = 0) -> Figure:
        """The figure of an answer."""
        return Figure(self.asked.path, "" if name == RIGHT else name, self.seen, trial)

    @property
    def figures(self) -> list[Figure]:
        """All figures, with those that tell what is noise."""
        module, _, function = self.asked.path.partition(".")
        arguments = {argument.name for argument in declared_function(module, function).arguments}
        trials = TRIALS if arguments & {"u", "rng"} else 1
        return [self.figure(name, trial) for name in self.named for trial in range(trials)]


Images = Mapping[Figure, Image.Image]


def planned(asked: Asked) -> Plan:
    """Choose the look and the order of the answers, the same whenever it is asked."""
    declared = asked.declared
    seen = declared.look
    if seen is None:
        seen = look_at(asked.path, declared.mistake)
    order = [declared.mistake, *declared.among]
    Random(f"answers of {asked.name}").shuffle(order)
    return Plan(asked, seen, tuple(order))


def drawn(figures: Iterable[Figure], kept: Path) -> dict[Figure, Image.Image]:
    """Have figures drawn that aren't kept in a folder."""
    images = {}
    for figure, (path, _) in STUDIO.files(dict.fromkeys(figures), kept).items():
        with Image.open(path) as image:
            images[figure] = image.convert("RGB")
    return images


def differences(plan: Plan, images: Images) -> dict[tuple[str, str], Difference]:
    """How far each two of the figures are apart."""
    images_of: dict[str, list[Image.Image]] = {name: [] for name in plan.named}
    for figure in plan.figures:
        images_of[figure.name or RIGHT].append(images[figure])
    trials = {name: Trials(each) for name, each in images_of.items()}
    return {
        (one, other): difference(trials[one], trials[other])
        for one, other in combinations(plan.named, 2)
    }


def check(plan: Plan, images: Images) -> dict[tuple[str, str], Difference]:
    """Measure a question's figures.

    Raises
    ------
    CourseError
        Two answers can't be told apart, or a mistake that is said to be unseen can be seen.
    """
    found = differences(plan, images)
    declared = plan.asked.declared
    for pair, measured in found.items():
        unseen = declared.ask == "unseen" and pair == (RIGHT, declared.mistake)
        if declared.ask == "unseen" and RIGHT not in pair:
            continue  # Which of the others a picture would be of isn't asked.
        if not (measured.alike if unseen else measured.apart):
            raise CourseError(
                f"{plan.asked.name}: the figures of {' and '.join(pair)} differ by {measured.ratio:.2f} times "
                f"their noise, which is too {'much' if unseen else 'little'} for the question"
            )
    return found


# ---------------------------------------------------------------- texts


def question(plan: Plan, images: Images) -> Question:
    """The question with its texts and pictures."""
    asked, ask = plan.asked, plan.asked.declared.ask
    asks, explained = _BY_KIND[ask](plan)
    pictures = ask == "predict"
    choices = tuple(
        Choice(
            f"Picture {LETTERS[place]}" if pictures else _mistake(asked, name),
            _told(asked, name),
        )
        for place, name in enumerate(plan.order)
    )
    shown = tuple(
        ShownPicture(title, alternative(plan, name, title, images), _png(images[plan.figure(name)]))
        for title, name in titles(plan)
    )
    answer = plan.order.index(asked.declared.mistake)
    return Question(
        asked.name,
        asked.module,
        asked.declared.function,
        asks,
        shown,
        choices,
        answer,
        explained,
    )


def titles(plan: Plan) -> list[tuple[str, str]]:
    """Title and name of each picture, in the order in which they are shown."""
    declared = plan.asked.declared
    if declared.ask == "predict":
        return [(f"Picture {LETTERS[place]}", name) for place, name in enumerate(plan.order)]
    if declared.ask == "unseen":
        return [("Right", RIGHT)]
    return [("Right", RIGHT), ("With a mistake", declared.mistake)]


def alternative(plan: Plan, name: str, title: str, images: Images) -> str:
    """What a picture shows, for those who don't see it; it doesn't tell which mistake made it."""
    about = f"{title}. {plan.shows}."
    if name == RIGHT and plan.asked.declared.ask != "predict":
        return about
    said = described(images[plan.figure(name)], images[plan.figure(RIGHT)])
    return f"{about} {said}"


def _which(plan: Plan) -> tuple[tuple[str, ...], str]:
    asked = plan.asked
    asks = (
        f"`{asked.path}` as it should be, and with a mistake. {plan.shows}.",
        "Which mistake made the second picture?",
    )
    return asks, _checked(asked, asked.declared.mistake) or _mistake(asked, asked.declared.mistake)


def _predict(plan: Plan) -> tuple[tuple[str, ...], str]:
    asked = plan.asked
    asks = (
        f"Somebody has written `{asked.path}` with this mistake: {_mistake(asked, asked.declared.mistake)}",
        f"Predict what comes of it before you look, and choose the picture. {plan.shows}.",
    )
    render = (
        f"Make the mistake in your own function and see it: "
        f"`course check {asked.module} --only {asked.declared.function} --html report.html`"
    )
    return asks, f"{_checked(asked, asked.declared.mistake)} {render}.".strip()


def _unseen(plan: Plan) -> tuple[tuple[str, ...], str]:
    asked = plan.asked
    asks = (
        f"`{asked.path}` as it should be. {plan.shows}.",
        "One of these mistakes leaves the picture as it is, but for noise. Which one, and why?",
    )
    return asks, f"{_mistake(asked, asked.declared.mistake)} {asked.declared.why}"


_BY_KIND = {"which": _which, "predict": _predict, "unseen": _unseen}


def _mistake(asked: Asked, name: str) -> str:
    return asked.wrong[name].about


def _checked(asked: Asked, name: str) -> str:
    """What the student is told who makes that mistake; empty if nothing is meant for it."""
    says = asked.says[name]
    return f'`course check` tells whoever makes it: "{says}"' if says else ""


def _told(asked: Asked, name: str) -> str:
    if name == asked.declared.mistake:
        return ""
    if name == RIGHT:
        return "This picture is the right one."
    if asked.declared.ask == "predict":
        return f"This picture is of another mistake: {_mistake(asked, name)}"
    if asked.declared.ask == "unseen":
        return f"That mistake would show. {_checked(asked, name)}".strip()
    return f"That mistake makes another picture. {_checked(asked, name)}".strip()


def _png(image: Image.Image) -> bytes:
    file = BytesIO()
    image.save(file, "png", optimize=True)
    return file.getvalue()
