"""Compiled loops in the place of a tracer's stages: the fused loop where it knows all that a scene uses."""

from course.compiled.fused import fits, fused
from course.core.tracer import Tracer


def compiled(tracer: Tracer) -> Tracer:
    """The tracer with compiled loops."""
    if fits(tracer):
        return fused(tracer)
    # Loops are compiled when they are imported: a machine's first render waits for those of its scene alone.
    from course.compiled import stages

    return stages.compiled(tracer)
