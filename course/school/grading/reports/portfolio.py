"""A student's own page: what the functions of each module have changed in its scene, and how fast the noise falls.

Every picture is rendered here, by the student's functions where they are written. The error of n samples a pixel is
told by two pictures that have no random number in common: half of their mean squared difference is the mean squared
error of each, without a converged picture.
"""

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from io import BytesIO
from itertools import count
from pathlib import Path
from time import monotonic
from typing import Any, NamedTuple

import numpy as np
from markupsafe import Markup
from PIL import Image

from course.base.errors import CourseError
from course.engine.functions.effects import Alone, Effects, NothingWritten
from course.engine.render.adaptive.rounds import ADAPTABLE
from course.engine.render.picture import Picture
from course.engine.render.render import reads_loops_first, render
from course.engine.scene.scene import Scene, load_scene
from course.school.grading.progress import FunctionProgress
from course.school.grading.reports.drawing import data_uri, draw_curve, with_own_ids
from course.school.grading.reports.order import place
from course.school.grading.reports.page import render as fill

SECONDS = 60.0
"""For all pictures together."""

WIDTH = 400
"""Columns of a picture at most [pixels]; it keeps the shape that its scene asks for."""

CURVE_WIDTH = 160
"""Columns of the pictures whose errors are measured at most [pixels]: an error is a mean over thousands of pixels."""

COUNTS = 1, 4, 16, 64
"""Samples a pixel at which the error is measured, as far as the time goes."""

SAMPLES = 64
"""Samples a pixel of a picture that is shown, as far as the time goes."""

ENOUGH = 16
"""Samples a pixel below which it is said why a picture has no more."""

TRIED = 4
"""Samples a pixel of a picture whose time tells that of one with more."""

LAST = "gallery/1984.yaml"
"""The scene of the last page: every function of the core modules brings one effect into it."""

QUALITY = 82
"""Of the WebP pictures. With it two pictures and a plot take 30 to 100 kB, so twenty modules stay under 2 MB."""


@dataclass(frozen=True)
class Shown:
    """A module on the page.

    Attributes
    ----------
    own : names of the student's functions that the picture called
    before, after : pictures as addresses of data; empty where there is none
    size : of both [pixels]
    curve : SVG of the error over the samples; empty where fewer than two were measured
    slope : by what power of the samples the error falls; None without a curve
    receipt : what the picture has cost, as pairs
    problem : why there is no picture; empty where there is one
    functions : how far each function is
    few : samples a pixel of before and after where the time was too short for ``SAMPLES``, else 0
    words : what is said of both pictures
    without : what is said of the one before
    fixed : samples a pixel of before and after where the scene places fewer than ``ENOUGH`` itself, else 0
    """

    module: str
    own: tuple[str, ...]
    before: str
    after: str
    size: tuple[int, int]
    curve: str
    slope: float | None
    receipt: tuple[tuple[str, str], ...]
    problem: str
    functions: tuple[FunctionProgress, ...]
    few: tuple[int, int] = (0, 0)
    words: str = ""
    without: str = "Without it"
    fixed: tuple[int, int] = (0, 0)

    @property
    def title(self) -> str:
        """For people."""
        return self.module.replace("_", " ").capitalize()


class Page(NamedTuple):
    """A portfolio.

    Attributes
    ----------
    text : HTML
    short : modules with a picture that has fewer samples than ``SAMPLES``, for want of time
    """

    text: str
    short: tuple[str, ...]


class _Clock:
    """Seconds, without those in which this process compiles loops: that is done once, and no picture is rendered."""

    def __init__(self) -> None:
        self.compiled = 0.0
        """Seconds of compiling so far."""

    def now(self) -> float:
        """Since some moment."""
        return monotonic() - self.compiled

    def add(self, seconds: float) -> None:
        """It has compiled so long."""
        self.compiled += seconds


def portfolio(
    found: list[list[FunctionProgress]],
    effects: Effects,
    scenes: Path,
    seconds: float = SECONDS,
    before: Callable[[str], None] = lambda _module: None,
) -> Page:
    """The page, in one file that needs no network.

    Parameters
    ----------
    found : the functions of each module, see `course.school.grading.progress.progress`
    effects : whose functions are called; those that aren't written are replaced
    scenes : a folder with a scene for each module, and in `before` the same without it
    seconds : for all pictures together; what is spent on compiling loops doesn't count
    before : called with the name of each module whose pictures are rendered
    """
    found = sorted(filter(None, found), key=lambda functions: place(functions[0].module))
    begun = [functions for functions in found if any(f.state != "to do" for f in functions)]
    plots = count(1)
    modules = list(_shown(begun, effects, scenes, seconds, before))
    short = tuple(one.module for one in modules if any(one.few))
    text = fill(
        "portfolio.html.jinja",
        modules=modules,
        short=[one for one in modules if one.module in short],
        samples=SAMPLES,
        seconds=seconds,
        right=sum(one.state == "right" for functions in found for one in functions),
        points=sum(one.points for functions in found for one in functions),
        of=sum(one.of for functions in found for one in functions),
        functions=sum(map(len, found)),
        left=[f[0].module for f in found if f not in begun],
        plot=lambda svg: Markup(with_own_ids(svg, f"p{next(plots)}")),
    )
    return Page(text, short)


def _shown(
    begun: list[list[FunctionProgress]],
    effects: Effects,
    scenes: Path,
    seconds: float,
    before: Callable[[str], None],
) -> Iterator[Shown]:
    clock = _Clock()
    end = clock.now() + seconds
    steps = [(functions[0].module, tuple(functions)) for functions in begun]
    last = scenes / LAST
    if begun and last.is_file():
        steps.append((last.stem, ()))
    for number, (module, functions) in enumerate(steps):
        before(module)
        # What a module leaves over is for those after it.
        share = max(end - clock.now(), 1.0) / (len(steps) - number)
        try:
            if functions:
                yield _rendered(module, functions, effects, scenes, share, clock)
            else:
                yield _homage(last, effects, share, clock)
        except (CourseError, NotImplementedError) as error:
            said = str(error) or type(error).__name__
            yield Shown(module, (), "", "", (0, 0), "", None, (), said, functions)


def _homage(path: Path, effects: Effects, seconds: float, clock: _Clock) -> Shown:
    """The last picture: the effects in it are those of one's own functions alone."""
    began = clock.now()
    after, few = _picture(load_scene(path, Alone(effects.folder)), 0.6 * seconds, clock)
    left = seconds - (clock.now() - began)
    earlier, few_before = _picture(load_scene(path, NothingWritten(effects.folder)), left, clock)
    own = tuple(after.receipt.effects.get("yours", ()))
    height, width = after.film.samples.shape
    return Shown(
        path.stem,
        own,
        _webp(earlier),
        _webp(after),
        (width, height),
        "",
        None,
        _costs(after),
        "",
        (),
        (few_before, few),
        "After the picture that began it all: each function that is written brings an effect into it.",
        "Nothing is written",
    )


def _rendered(
    module: str,
    functions: tuple[FunctionProgress, ...],
    effects: Effects,
    scenes: Path,
    seconds: float,
    clock: _Clock,
) -> Shown:
    began = clock.now()
    path = scenes / f"{module}.yaml"
    if not path.is_file():
        return Shown(module, (), "", "", (0, 0), "", None, (), f"no scene {path}", functions)
    scene = load_scene(path, effects)
    after, few = _picture(scene, 0.4 * seconds, clock)
    points = tuple(_errors(scene, began + 0.65 * seconds, clock))
    without = scenes / "before" / f"{module}.yaml"
    earlier, few_before, fixed_before = "", 0, 0
    if without.is_file():
        left = seconds - (clock.now() - began)
        before = load_scene(without, effects)
        picture, few_before = _picture(before, left, clock)
        earlier, fixed_before = _webp(picture), _own_number(before, picture)
    height, width = after.film.samples.shape
    return Shown(
        module,
        tuple(after.receipt.effects.get("yours", ())),
        earlier,
        _webp(after),
        (width, height),
        draw_curve(points) if len(points) > 1 else "",
        _slope(points),
        _costs(after),
        "",
        functions,
        (few_before, few),
        fixed=(fixed_before, _own_number(scene, after)),
    )


def _own_number(scene: Scene, picture: Picture) -> int:
    """Samples a pixel of a picture whose scene places so few itself that it must be told; else 0."""
    samples = math.ceil(picture.receipt.samples)
    return samples if _fixed(scene) and samples < ENOUGH else 0


def _costs(picture: Picture) -> tuple[tuple[str, str], ...]:
    receipt = picture.receipt
    return (
        ("samples a pixel", f"{receipt.samples:g}"),
        ("rays", f"{sum(receipt.rays.values()):,}"),
        ("in Embree, of all threads", f"{receipt.embree_seconds:.2f} s"),
        ("by the clock", f"{receipt.wall_seconds:.2f} s"),
        ("functions called", ", ".join(receipt.effects["called"])),
    )


def _errors(scene: Scene, end: float, clock: _Clock) -> Iterator[tuple[int, float]]:
    """Samples a pixel and root-mean-square errors [radiance], until the next one would end too late."""
    size = _within(scene, CURVE_WIDTH)
    if _fixed(scene):
        return
    for samples in COUNTS:
        began = clock.now()
        a, b = (_whole(scene, clock, spp=samples, size=size, seed=seed).linear for seed in (1, 2))
        yield samples, math.sqrt(float(((a - b) ** 2).mean(dtype=np.float64)) / 2)
        if clock.now() + 4 * (clock.now() - began) > end:
            return


def _fixed(scene: Scene) -> bool:
    """True if the number of samples is the scene's own: they are placed at once, or a preview is about their number."""
    settings = scene.settings
    special = settings.subdivision is not None or settings.denoise is not None
    return special or settings.sampler not in ADAPTABLE


def _slope(points: tuple[tuple[int, float], ...]) -> float | None:
    """Power of the samples by which the error falls, by least squares in both logarithms."""
    seen = [(n, error) for n, error in points if error > 0]
    if len(seen) < 2:
        return None
    n, error = np.log(np.array(seen)).T
    return float(-np.polyfit(n, error, 1)[0])


def _picture(scene: Scene, seconds: float, clock: _Clock) -> tuple[Picture, int]:
    """With the most samples, a power of 2, that seem to fit into the time; all pixels have them.

    Returns Picture, and their number if the time is too short for ``SAMPLES``, else 0.
    """
    size = _within(scene, WIDTH)
    if _fixed(scene):
        return _whole(scene, clock, size=size), 0
    end = clock.now() + seconds
    # The first picture of a scene makes its stages: what samples take is told by the next.
    picture, samples = _whole(scene, clock, spp=1, size=size), 1
    for _ in range(2):
        began, compiled = clock.now(), clock.compiled
        if began >= end:
            break
        picture, samples = _whole(scene, clock, spp=TRIED, size=size), TRIED
        each = (clock.now() - began) / TRIED
        fitting = 2 ** int(math.log2(min(max((end - clock.now()) / each, 1.0), SAMPLES)))
        # A render in which loops were compiled doesn't tell how fast they are.
        if clock.compiled == compiled:
            if fitting > TRIED:
                picture, samples = _whole(scene, clock, spp=fitting, size=size), fitting
            break
    return picture, samples if samples < SAMPLES else 0


def _whole(scene: Scene, clock: _Clock, **settings: Any) -> Picture:
    """A picture that all of its samples are in; Ctrl-C, which would leave a part of it, ends the page."""
    with ExitStack() as closed:
        # Numba takes a second to be imported, and small pictures do without.
        if "numba" in sys.modules or reads_loops_first(scene.settings, **settings):
            from numba.core import event

            closed.enter_context(event.install_timer("numba:compile", clock.add))
        picture = render(scene, **settings)
    if picture.interrupted:
        raise KeyboardInterrupt
    return picture


def _within(scene: Scene, width: int) -> tuple[int, int]:
    settings = scene.settings
    columns = min(settings.width, width)
    return columns, max(round(settings.height * columns / settings.width), 1)


def _webp(picture: Picture) -> Markup:
    buffer = BytesIO()
    codes = picture.settings.display.codes(picture.shown)
    Image.fromarray(codes).save(buffer, "webp", quality=QUALITY)
    return data_uri("webp", buffer.getvalue())
