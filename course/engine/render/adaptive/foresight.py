"""What a scene tells of its picture's error before any sample: small bright things, and where they may be seen."""

from dataclasses import dataclass, replace

from course.engine.render.adaptive.bright import bright_things, parts_of
from course.engine.render.adaptive.bright_sky import small_lights, stars
from course.engine.render.adaptive.glimpses import FIRST, UNIMPORTANT, glimpses
from course.engine.render.adaptive.prior import Prior
from course.engine.render.adaptive.reflections import Reflections
from course.engine.render.adaptive.seen_ahead import CameraAxes, can_be_asked
from course.engine.render.adaptive.unbounded import unbounded
from course.engine.render.job import Job
from course.engine.scene.building.cameras import compile_camera


@dataclass(frozen=True)
class Foresight:
    """What is known before the first sample.

    Attributes
    ----------
    prior : of the pixels that may see small bright things; None where no thing matters
    rays : that were sent ahead to know it
    unbounded : what the estimate of the error doesn't bound, by name
    """

    prior: Prior | None = None
    rays: int = 0
    unbounded: tuple[str, ...] = ()


def foresee(job: Job, error: float) -> Foresight:
    """What is known of a render that aims at an error [radiance] before it begins."""
    world, settings, loaded = job.scene.compiled.world, job.settings, job.scene.loaded
    target, width, height = error**2, settings.width, settings.height
    if not target:
        return Foresight()
    parts = parts_of(world)
    things = list(bright_things(world, parts))
    # A pixel of it leaves as much as matters after the first samples.
    bright = FIRST * UNIMPORTANT * target * width * height
    if not can_be_asked(world):
        some = (
            any(thing.square > bright for thing in things)
            or small_lights(world, bright) is not None
        )
        why = "small bright things, for acceleration.type is hierarchy and no ray is sent ahead"
        return Foresight(unbounded=(why,) if some else ())
    camera = replace(
        compile_camera(loaded, job.scene.compiled.frame, width, height), lens=world.lens
    )
    view = CameraAxes.of(camera, world, width, height)
    if not view.pixel:
        # Of an angle so small that float32 has no steps, all pixels see one point.
        return Foresight()
    chances = glimpses(world, view, things, parts, target)
    reflections = Reflections(world, view, things, parts, target, settings.max_depth)
    chances += reflections.chances()
    chances += stars(world, view, bright)
    left = float((chances.square - chances.mean**2).mean()) / FIRST
    return Foresight(
        Prior(chances, target) if left > UNIMPORTANT * target else None,
        chances.rays,
        unbounded(
            loaded.description, world, things, bright, settings.max_depth, reflections.cut_short
        ),
    )
