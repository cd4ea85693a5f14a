"""Compiled loops in the place of a tracer's stages: the fused loop where it knows all that a scene uses."""

from dataclasses import replace

from course.engine.core.tracer import Tracer
from course.engine.loops.fits import fits
from course.engine.loops.light_tree import compiled_choice
from course.engine.terms.lights.light_choice import LightChoice
from course.engine.terms.shafts.stage import sparing


def has_loops(tracer: Tracer) -> bool:
    """True if anything of a scene has a compiled form; no loop is read to say so."""
    choice = _choice(tracer)
    return fits(tracer) or compiled_choice(choice) is not choice


def compiled(tracer: Tracer, shafts: bool = False) -> Tracer:
    """The tracer with compiled loops; of a scene that doesn't fit them, with the walk down its tree of lights alone.

    ``shafts``: whether the loop leaves out shadow rays whose answer a shaft tells
    """
    if fits(tracer):
        # Loops are compiled when they are imported: a machine's first render waits for those of its scene alone.
        from course.engine.loops.fused import fused

        return fused(sparing(tracer) if shafts else tracer)
    choice = _choice(tracer)
    if choice is None:
        return tracer
    integrator = tracer.integrator
    assert integrator.direct is not None
    direct = replace(integrator.direct, choice=compiled_choice(choice))
    return replace(tracer, integrator=replace(integrator, direct=direct))


def _choice(tracer: Tracer) -> LightChoice | None:
    direct = tracer.integrator.direct
    choice = None if direct is None else direct.choice
    return choice if isinstance(choice, LightChoice) else None
