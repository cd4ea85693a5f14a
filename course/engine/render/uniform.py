"""Uniform sampling: it can continue a picture with fewer samples, and stop at a time limit."""

from dataclasses import replace
from functools import partial

from course.base.errors import CourseError
from course.engine.core.film import Film
from course.engine.core.samplers import Sampler
from course.engine.core.schedule import Executor, Run, UniformSchedule
from course.engine.core.tiles import PASS, pass_size
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import Bound
from course.engine.render.job import Job, Mode
from course.engine.terms.work import DividedSchedule, preview


class TimedSchedule(DividedSchedule):
    """Uniform passes until the executor's deadline."""

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        settings = self.tracer.settings
        size = pass_size(settings, self.tracer.sampler)
        for quick in (1, 4):
            # If a whole pass surely fits, a preview would be wasted.
            if size <= quick or self.done:
                break
            before = executor.seconds_left
            run(preview(settings, quick), 0.0, 0.0)
            if executor.interrupted:
                return False
            seconds = before - executor.seconds_left
            if seconds * size / quick < 0.5 * executor.seconds_left:
                break
        return run(self.work(executor))


def make(
    schedule: type[UniformSchedule], job: Job, tracer: Tracer, _bound: Bound
) -> tuple[Film, UniformSchedule]:
    """See ``Mode``."""
    film, done = _film(job, tracer.sampler)
    return film, schedule(tracer, done)


UNIFORM = Mode(partial(make, DividedSchedule))
TIMED = Mode(partial(make, TimedSchedule))


def _film(job: Job, sampler: Sampler) -> tuple[Film, int]:
    """An empty film, or that of the picture to continue, and the number of samples that it holds."""
    start, settings = job.start, job.settings
    if start is None:
        return Film(settings.width, settings.height), 0
    same = replace(start.settings, samples=settings.samples) == settings
    if not same or not start.complete or start.settings.samples > settings.samples:
        raise CourseError(
            "only a complete picture of the same settings and fewer samples can be continued"
        )
    if not sampler.extensible:
        raise CourseError(
            f"the {settings.sampler} sampler places all its samples at once; start afresh"
        )
    done = start.settings.samples - start.settings.samples % PASS  # whole passes
    assert isinstance(start.film, Film)
    return start.film.continued(done), done
