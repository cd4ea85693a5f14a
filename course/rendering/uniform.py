"""The schedule of uniform sampling: every pixel gets the same samples, pass by pass."""

from __future__ import annotations

from collections.abc import Iterator

from course.rendering.passes import Work, passes
from course.rendering.pool import Executor
from course.rendering.render import Run, Schedule
from course.transport.tracing import Tracer


class UniformSchedule(Schedule):
    """All passes in one round.

    Parameters
    ----------
    done : samples of each pixel that the film already holds, a multiple of ``course.rendering.passes.PASS``
    """

    def __init__(self, tracer: Tracer, done: int = 0) -> None:
        self._tracer = tracer
        self._done = done

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        return run(list(self._passes(executor)))

    def _passes(self, executor: Executor) -> Iterator[Work]:
        tracer = self._tracer
        batches = executor.batches(tracer.batches)
        return passes(tracer.settings, tracer.sampler, self._done, batches, executor.threads)
