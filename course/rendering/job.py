"""One render as it was asked for, and the modes that it may be done in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from course.effects import Bound
from course.errors import CourseError, OutputError
from course.imaging.film import AnyFilm
from course.rendering.picture import Picture
from course.rendering.render import Schedule
from course.scene.consistency import nearest_squares
from course.scene.scene import Scene
from course.scene.world import Settings
from course.transport.tracing import Tracer

MOST_SAMPLES = 65536

BYTES_A_PIXEL = 64
"""Sums, weights, the picture itself, and its copies on the way to a file."""


@dataclass(frozen=True)
class Job:
    """What is to be rendered.

    Attributes
    ----------
    settings : those of the scene, or what was asked for in their place
    time_limit : seconds, or None
    start : a picture to be continued, or None
    """

    scene: Scene
    settings: Settings
    time_limit: float | None = None
    start: Picture | None = None


@dataclass(frozen=True)
class Mode:
    """A way to spread samples over a picture: a film and a schedule that go together.

    Attributes
    ----------
    check : raises CourseError for a job that can't be done in this mode
    make : the film and the schedule of a job; the functions of the course that they call are noted down in ``Bound``
    bytes_a_pixel : of memory
    final : what a picture is called that can't be continued; None where it can
    """

    check: Callable[[Job], None]
    make: Callable[[Job, Tracer, Bound], tuple[AnyFilm, Schedule]]
    bytes_a_pixel: int = BYTES_A_PIXEL
    final: str | None = None


def chosen_settings(
    scene: Scene,
    spp: int | None,
    size: tuple[int, int] | None,
    sampler: str | None,
    seed: int | None,
    error: float | None,
    ends_early: bool,
) -> Settings:
    """The scene's settings with what was given in their place; see ``course.rendering.rendering.render``.

    Parameters
    ----------
    ends_early : something else than the number of samples is to end the render

    Raises
    ------
    CourseError
        There is no such picture, or its sampler has no such number of samples.
    """
    settings = scene.settings
    sampler = sampler or settings.sampler
    if spp is None and ends_early and sampler in ("sobol", "random", "halton", "xorshift"):
        spp = MOST_SAMPLES
    width, height = size or (settings.width, settings.height)
    settings = replace(
        settings,
        samples=settings.samples if spp is None else spp,
        width=width,
        height=height,
        sampler=sampler,
        seed=settings.seed if seed is None else seed,
        error=error or settings.error,
    )
    if width < 1 or height < 1:
        raise OutputError(f"a picture of {width} x {height} pixels has no pixels")
    if settings.samples < 1:
        raise CourseError(f"{settings.samples} samples a pixel: expected at least 1")
    if sampler in ("regular", "jittered"):
        squares = nearest_squares(settings.samples)
        if settings.samples not in squares:
            raise CourseError(
                f"the {sampler} sampler needs a square number of samples, not {settings.samples}; "
                f"the nearest are {' and '.join(map(str, squares))}"
            )
    return settings


def check_memory(settings: Settings, bytes_a_pixel: int) -> None:
    """Refuse a picture that is larger than the memory that is free.

    Raises
    ------
    OutputError
    """
    needed = settings.width * settings.height * bytes_a_pixel
    if needed < 256e6:
        return
    import psutil

    available = psutil.virtual_memory().available
    if needed > available:
        raise OutputError(
            f"a picture of {settings.width} x {settings.height} needs about {needed / 1e9:.1f} GB of memory, "
            f"{available / 1e9:.1f} GB are free; render a smaller one (--size)"
        )
