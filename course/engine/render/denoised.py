"""Uniform sampling into a film that is denoised when it is complete: a preview, whose means are biased."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from course.base.errors import CourseError
from course.engine.core.schedule import Executor, Run
from course.engine.core.tiles import Work
from course.engine.core.tracer import Tracer
from course.engine.core.types import Functions
from course.engine.functions.effects import Bound
from course.engine.render.job import Job, Mode
from course.engine.scene.scene import Denoising
from course.engine.terms.denoising import MomentsFilm, functions
from course.engine.terms.work import DividedSchedule

BYTES_A_PIXEL = 160
"""Sums, means, squares and samples, the picture, and its preview."""


@dataclass(frozen=True, kw_only=True)
class DenoisingSchedule(DividedSchedule):
    """Uniform passes, each of whose samples is handed to the film, and the preview in the end.

    ``told``: what `MomentsFilm.denoise` says of it.
    """

    film: MomentsFilm
    rule: Denoising
    functions: Functions
    told: dict[str, float] = field(default_factory=dict)

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``; a picture that was interrupted has no preview."""
        complete = super().render(run, executor)
        if complete:
            self.told.update(self.film.denoise(self.functions, self.rule.level, self.rule.sigma))
        return complete

    def receipt(self) -> dict[str, Any]:
        """What the filter has changed, by its own estimate."""
        return {"denoising": self.told or None}

    def work(self, executor: Executor) -> Iterator[Work]:
        """See ``UniformSchedule``."""
        return (replace(work, parts=work.samples) for work in super().work(executor))


def make(job: Job, tracer: Tracer, bound: Bound) -> tuple[MomentsFilm, DenoisingSchedule]:
    """See ``Mode``."""
    rule = job.settings.denoise
    assert rule is not None
    film = MomentsFilm(job.settings.width, job.settings.height)
    return film, DenoisingSchedule(tracer, film=film, rule=rule, functions=functions(bound))


def check(job: Job) -> None:
    """Refuse what has no variance of independent samples to be tested, by a CourseError."""
    settings = job.settings
    if settings.samples < 2:
        raise CourseError("denoise needs 2 samples a pixel or more, to tell how much they vary")
    if settings.error is not None or settings.subdivision is not None:
        raise CourseError(
            "denoise is for samples that are uniform over the picture: leave film.error (--error) and"
            " film.subdivision out"
        )
    if job.time_limit is not None:
        raise CourseError("denoise takes its time after the rays: give samples (--spp), no limit")
    if job.scene.loaded.description.film.filter != "box":
        raise CourseError("denoise tests samples of equal weight: film.filter has to be box")


DENOISED = Mode(make, check, BYTES_A_PIXEL, "a denoised preview")
