"""The schedule under a time limit: a preview, so that every pixel has something, then as many passes as fit."""

from __future__ import annotations

from course.core.passes import pass_size, preview
from course.core.render import Run, UniformSchedule
from course.core.threads import Executor


class TimedSchedule(UniformSchedule):
    """Uniform passes until the executor's deadline."""

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        settings = self._tracer.settings
        size = pass_size(settings, self._tracer.sampler)
        for quick in (1, 4):
            # Where a whole pass surely fits, a preview only costs.
            if size <= quick or self._done:
                break
            before = executor.seconds_left
            run(preview(settings, quick), 0.0, 0.0)
            if executor.interrupted:
                return False
            seconds = before - executor.seconds_left
            if seconds * size / quick < 0.5 * executor.seconds_left:
                break
        return run(self._passes(executor))
