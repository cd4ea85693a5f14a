"""A student's own page: what the functions of each module have changed in its scene, and how fast the noise falls.

Every picture is rendered here, by the student's functions where they are written. The error of n samples a pixel is
told by two pictures that have no random number in common: half of their mean squared difference is the mean squared
error of each, without a converged picture.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from itertools import count
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from markupsafe import Markup
from PIL import Image

from course.adaptive.rounds import ADAPTABLE
from course.effects import Effects
from course.errors import CourseError
from course.grading.progress import Progress
from course.grading.reports.drawing import data_uri, draw_curve, with_own_ids
from course.grading.reports.order import place
from course.grading.reports.page import render as fill
from course.jobs.picture import Picture
from course.render_scene import render
from course.scene.scene import Scene, load_scene

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

TRIED = 4
"""Samples a pixel of a small picture whose time tells that of the large one."""

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
    functions: tuple[Progress, ...]

    @property
    def title(self) -> str:
        """For people."""
        return self.module.replace("_", " ").capitalize()


def portfolio(
    found: list[list[Progress]],
    effects: Effects,
    scenes: Path,
    seconds: float = SECONDS,
    before: Callable[[str], None] = lambda _module: None,
) -> str:
    """The page, in one file that needs no network.

    Parameters
    ----------
    found : the functions of each module, see `course.grading.progress.progress`
    effects : whose functions are called; those that aren't written are replaced
    scenes : a folder with a scene for each module, and in `before` the same without it
    seconds : for all pictures together
    before : called with the name of each module whose pictures are rendered
    """
    found = sorted(filter(None, found), key=lambda functions: place(functions[0].module))
    begun = [functions for functions in found if any(f.state != "to do" for f in functions)]
    plots = count(1)
    return fill(
        "portfolio.html.jinja",
        modules=list(_shown(begun, effects, scenes, seconds, before)),
        right=sum(one.state == "right" for functions in found for one in functions),
        points=sum(one.points for functions in found for one in functions),
        of=sum(one.of for functions in found for one in functions),
        functions=sum(map(len, found)),
        left=[f[0].module for f in found if f not in begun],
        plot=lambda svg: Markup(with_own_ids(svg, f"p{next(plots)}")),
    )


def _shown(
    begun: list[list[Progress]],
    effects: Effects,
    scenes: Path,
    seconds: float,
    before: Callable[[str], None],
) -> Iterator[Shown]:
    end = monotonic() + seconds
    for number, functions in enumerate(begun):
        module = functions[0].module
        before(module)
        # What a module leaves over is for those after it.
        share = max(end - monotonic(), 1.0) / (len(begun) - number)
        try:
            yield _rendered(module, tuple(functions), effects, scenes, share)
        except (CourseError, NotImplementedError) as error:
            said = str(error) or type(error).__name__
            yield Shown(module, (), "", "", (0, 0), "", None, (), said, tuple(functions))


def _rendered(
    module: str, functions: tuple[Progress, ...], effects: Effects, scenes: Path, seconds: float
) -> Shown:
    began = monotonic()
    path = scenes / f"{module}.yaml"
    if not path.is_file():
        return Shown(module, (), "", "", (0, 0), "", None, (), f"no scene {path}", functions)
    scene = load_scene(path, effects)
    points = tuple(_errors(scene, began + 0.5 * seconds))
    left = seconds - (monotonic() - began)
    after = _picture(scene, 0.7 * left)
    without = scenes / "before" / f"{module}.yaml"
    earlier = ""
    if without.is_file():
        earlier = _webp(_picture(load_scene(without, effects), seconds - (monotonic() - began)))
    receipt = after.receipt
    rays = sum(receipt.rays.values())
    height, width = after.film.samples.shape
    return Shown(
        module,
        tuple(receipt.effects.get("yours", ())),
        earlier,
        _webp(after),
        (width, height),
        draw_curve(points) if len(points) > 1 else "",
        _slope(points),
        (
            ("samples a pixel", f"{receipt.samples:g}"),
            ("rays", f"{rays:,}"),
            ("in Embree, of all threads", f"{receipt.embree_seconds:.2f} s"),
            ("by the clock", f"{receipt.wall_seconds:.2f} s"),
            ("functions called", ", ".join(receipt.effects["called"])),
        ),
        "",
        functions,
    )


def _errors(scene: Scene, end: float) -> Iterator[tuple[int, float]]:
    """Samples a pixel and root-mean-square errors [radiance], until the next one would end too late."""
    size = _within(scene, CURVE_WIDTH)
    if _fixed(scene):
        return
    for samples in COUNTS:
        began = monotonic()
        a, b = (_whole(scene, spp=samples, size=size, seed=seed).linear for seed in (1, 2))
        yield samples, math.sqrt(float(((a - b) ** 2).mean(dtype=np.float64)) / 2)
        if monotonic() + 4 * (monotonic() - began) > end:
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


def _picture(scene: Scene, seconds: float) -> Picture:
    """With the most samples, a power of 2, that seem to fit into the time; all pixels have them."""
    size = _within(scene, WIDTH)
    if _fixed(scene):
        return _whole(scene, size=size)
    small, began = _within(scene, CURVE_WIDTH), monotonic()
    _whole(scene, spp=TRIED, size=small)
    each = (monotonic() - began) / TRIED * math.prod(size) / math.prod(small)
    fitting = min(max(seconds / each, 1.0), SAMPLES)
    return _whole(scene, spp=2 ** int(math.log2(fitting)), size=size)


def _whole(scene: Scene, **settings: Any) -> Picture:
    """A picture that all of its samples are in; Ctrl-C, which would leave a part of it, ends the page."""
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
