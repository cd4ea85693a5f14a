"""The mode that samples until the picture's error is small enough (``course.engine.render.adaptive.rounds``)."""

from math import inf, isfinite
from typing import Any

from course.base.errors import CourseError
from course.engine.core.schedule import Executor, Run, Schedule
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import Bound
from course.engine.render.adaptive.allocation import FIRST, FIRST_OF_NET
from course.engine.render.adaptive.film import AdaptiveFilm
from course.engine.render.adaptive.foresight import Foresight, foresee
from course.engine.render.adaptive.rounds import ADAPTABLE, RoundGroups, render_adaptively
from course.engine.render.job import Job, Mode
from course.engine.terms.work import preview

NET = "sobol"
"""The sampler whose points are a net; those of the others are independent."""


class AdaptiveSchedule(Schedule):
    """Rounds in which samples go where the film's estimated error is.

    Parameters
    ----------
    target : root-mean-square error of the whole picture [radiance]
    foresight : what the scene has told before any sample
    """

    def __init__(
        self, film: AdaptiveFilm, tracer: Tracer, target: float, foresight: Foresight
    ) -> None:
        self._film = film
        self._tracer = tracer
        self._target = target
        self._foresight = foresight

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``; under a deadline a preview comes first, so that every pixel has something."""
        settings = self._tracer.settings
        if executor.seconds_left < inf:
            run(preview(settings, 1), 0.0, 0.0)
            if executor.interrupted:
                return False
        budget = settings.samples * settings.width * settings.height
        batches = executor.batches(self._tracer.batches)
        groups = RoundGroups(settings.width, batches, executor.threads, self._tracer.smallest)
        first = first_samples(settings.sampler)
        return render_adaptively(self._film, self._target, budget, groups, run, first)

    def receipt(self) -> dict[str, Any]:
        """The error that was reached, and the samples that it took."""
        film = self._film
        uniform = film.uniform_samples
        spent = (float(film.samples.sum()) + film.audited) / film.samples.size
        return {
            "error": {
                "target": self._target,
                "estimated": film.error,
                "fewest": int(film.samples.min()),
                "most": int(film.samples.max()),
                "audited": film.audited,
                "foreseen": self._foresight.rays,
                "uniform": uniform,
                "saved": 1.0 - spent / uniform if uniform else 0.0,
            }
            | ({"not bounded": list(told)} if (told := self._foresight.unbounded) else {})
        }

    @property
    def note(self) -> str:
        """See ``Schedule``."""
        told = self._foresight.unbounded
        return f"not bounded: {'; '.join(told)}" if told else ""


def first_samples(sampler: str) -> int:
    """Samples of each pixel before anything is known of it."""
    return FIRST_OF_NET if sampler == NET else FIRST


def check(job: Job) -> None:
    """See ``Mode``: samplers must be able to go on anywhere, and tell their error."""
    error, sampler, samples = job.settings.error, job.settings.sampler, job.settings.samples
    if error is None or not (isfinite(error) and error > 0):
        raise CourseError(f"an error of {error}: expected a finite radiance > 0")
    if sampler == "halton":
        raise CourseError(
            "the halton sampler moves all points of a pixel together, so they don't tell their error; "
            "use sobol, random or xorshift"
        )
    if sampler not in ADAPTABLE:
        raise CourseError(
            f"the {sampler} sampler places all its samples at once, so it can't go on where the error is; "
            "use sobol, random or xorshift"
        )
    if samples < first_samples(sampler):
        raise CourseError(
            f"{samples} samples a pixel: an error can be aimed at with {first_samples(sampler)} or more"
        )


def make(job: Job, tracer: Tracer, _bound: Bound) -> tuple[AdaptiveFilm, AdaptiveSchedule]:
    """See ``Mode``."""
    assert job.settings.error is not None
    settings, kind = job.settings, AdaptiveFilm
    if job.compiled:
        from course.engine.render.adaptive.compiled_film import CompiledFilm

        kind = CompiledFilm
    foresight = foresee(job, job.settings.error)
    film = kind(settings.width, settings.height, settings.sampler == NET, foresight.prior)
    return film, AdaptiveSchedule(film, tracer, job.settings.error, foresight)


ADAPTIVE = Mode(make, check, final="a picture with an error to aim at")
