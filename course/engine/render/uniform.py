"""Uniform sampling: it can continue a picture with fewer samples, and stop at a time limit."""

from dataclasses import replace
from functools import partial

from course.base.errors import CourseError
from course.engine.core.film import Film
from course.engine.core.samplers import Sampler
from course.engine.core.schedule import Executor, Run, UniformSchedule
from course.engine.core.tiles import PASS, Work, pass_size
from course.engine.core.tracer import Tracer
from course.engine.functions.effects import Bound
from course.engine.render.job import Job, Mode
from course.engine.terms.work import DividedSchedule, preview, whole_pass

MANY = 64
"""Samples that there is time for, from which on the border of a pass that is cut short can't be seen."""

FAR = 16
"""How many times the samples that there is time for are asked for, at least, where no pass must be a whole one."""

SURELY = 0.8
"""Share of the time left that a pass is planned for."""


class TimedSchedule(DividedSchedule):
    """Uniform passes until the executor's deadline."""

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        settings, sampler = self.tracer.settings, self.tracer.sampler
        size = pass_size(settings, sampler)
        for quick in (1, 4):
            # If a whole pass surely fits, a preview would be wasted.
            if size <= quick or self.done:
                break
            fitting = _fitting(run, executor, preview(settings, quick), quick)
            if executor.interrupted:
                return False
            if sampler.extensible and fitting < min(MANY, settings.samples / FAR):
                return self._evenly(run, executor, fitting)
            if size < 0.5 * fitting:
                break
        return run(self.work(executor))

    def _evenly(self, run: Run, executor: Executor, fitting: float) -> bool:
        """Passes over the whole picture, each with as many samples as there is time for: ``fitting``, at first.

        A pass of always as many would end somewhere in the picture, and its border would be seen.
        """
        settings, done = self.tracer.settings, 0
        while executor.seconds_left > 0 and not executor.interrupted:
            # One sample would be that of the preview.
            least = 1 if done else 2
            samples = min(max(int(SURELY * fitting), least), PASS, settings.samples - 1 - done)
            work = whole_pass(settings, done, samples, summed=True)
            fitting = _fitting(run, executor, work, samples)
            done += samples
        return False


def _fitting(run: Run, executor: Executor, work: list[Work], samples: int) -> float:
    """Do a pass of so many samples; return how many more there is time for."""
    before = executor.seconds_left
    run(work, 0.0, 0.0)
    left = executor.seconds_left
    return samples * left / max(before - left, 1e-9)


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
