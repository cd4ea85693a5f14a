"""A render as it was asked for, and the modes that it may be done in."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from course.base.errors import CourseError, OutputError
from course.engine.core.film import AnyFilm
from course.engine.core.schedule import Schedule
from course.engine.core.tracer import Tracer
from course.engine.formats.yaml.consistency import nearest_squares
from course.engine.functions.effects import Bound
from course.engine.render.picture import Picture
from course.engine.scene.scene import Scene, SceneSettings

EXTENSIBLE = ("sobol", "random", "halton", "xorshift")
"""Samplers that can go on for as long as there is time, with so many samples at most."""

MOST_SAMPLES = 65536

BYTES_A_PIXEL = 64
"""Sums, weights, the picture itself, and its copies on the way to a file."""


@dataclass(frozen=True)
class Job:
    """A render as it was asked for.

    Attributes
    ----------
    settings : those of the scene, or what was asked for in their place
    time_limit : seconds, or None
    start : a picture to be continued, or None
    compiled : whether loops are compiled before the first sample
    """

    scene: Scene
    settings: SceneSettings
    time_limit: float | None = None
    start: Picture | None = None
    compiled: bool = False


@dataclass(frozen=True)
class Mode:
    """A way to spread samples over a picture: a film and a schedule that go together.

    Attributes
    ----------
    make : the film and the schedule of a job; the functions of the course that they call are noted down in ``Bound``
    check : raises CourseError for a job that can't be done in this mode
    bytes_a_pixel : of memory
    final : what a picture is called that can't be continued; None where it can
    """

    make: Callable[[Job, Tracer, Bound], tuple[AnyFilm, Schedule]]
    check: Callable[[Job], None] = lambda _job: None
    bytes_a_pixel: int = BYTES_A_PIXEL
    final: str | None = None


_WHOLE = {"samples": "spp", "seed": "seed", "width": "size", "height": "size"}
"""Settings that are whole numbers, and how `course.render` calls them."""


def check_whole(what: str, value: object, more: str = "") -> None:
    """Raise CourseError for what is neither None nor a whole number, such as NumPy's; ``more`` is said after it."""
    if value is not None and not hasattr(value, "__index__"):
        raise CourseError(f"{what}: {value!r} is no whole number{more}")


def chosen_settings(
    settings: SceneSettings, ends_early: bool, size: Any = None, **given: Any
) -> SceneSettings:
    """The settings, with what was given and isn't None in their place; CourseError for what can't be.

    Parameters
    ----------
    ends_early : something else than the number of samples is to end the render
    size : (width, height) [pixels]
    """
    if size is not None:
        if not isinstance(size, tuple | list) or len(size) != 2:
            raise CourseError(
                f"size={size!r}: expected (width, height) in pixels, such as (400, 267)"
            )
        given |= {"width": size[0], "height": size[1]}
    for name, own in _WHOLE.items():
        check_whole(own, given.get(name))
    chosen = replace(
        settings, **{name: value for name, value in given.items() if value is not None}
    )
    if ends_early and given["samples"] is None and chosen.sampler in EXTENSIBLE:
        chosen = replace(chosen, samples=MOST_SAMPLES)
    if chosen.width < 1 or chosen.height < 1:
        raise OutputError(f"a picture of {chosen.width} x {chosen.height} pixels has no pixels")
    if chosen.samples < 1:
        raise CourseError(f"{chosen.samples} samples a pixel: expected at least 1")
    if chosen.sampler in ("regular", "jittered"):
        squares = nearest_squares(chosen.samples)
        if chosen.samples not in squares:
            raise CourseError(
                f"the {chosen.sampler} sampler needs a square number of samples, not {chosen.samples}; "
                f"the nearest are {' and '.join(map(str, squares))}"
            )
    return chosen


def check_memory(settings: SceneSettings, bytes_a_pixel: int) -> None:
    """Raise OutputError for a picture that is larger than the memory that is free."""
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
