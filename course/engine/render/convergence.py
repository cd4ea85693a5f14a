"""How the error of a scene's pictures falls with the time that is spent, without a converged picture.

Two pictures of the same samples that have no random number in common: half of their mean squared difference is the
mean squared error of each.
"""

import math
from dataclasses import dataclass
from io import BytesIO
from itertools import count
from time import monotonic

from course.base.errors import CourseError
from course.engine.render.adaptive.rounds import ADAPTABLE
from course.engine.render.render import render
from course.engine.scene.scene import Scene, check_scene

WIDTH = 160
"""Columns of the pictures at most [pixels]: an error is a mean over thousands of pixels."""

DOTS = 110
"""Of an inch of the plot."""

LONGER = 4
"""Times as long as one picture the next takes, which has so many times its samples."""


@dataclass(frozen=True)
class ErrorPoint:
    """One measurement: samples a pixel, seconds of one picture, and its root-mean-square error [radiance]."""

    samples: int
    seconds: float
    error: float


@dataclass(frozen=True, repr=False)
class ErrorOverTime:
    """Errors of a scene's pictures; a notebook shows them as a plot.

    Attributes
    ----------
    title : of the scene
    points : sampler -> what was measured, samples growing
    """

    title: str
    points: dict[str, tuple[ErrorPoint, ...]]

    def __repr__(self) -> str:
        rows = [f"{'sampler':<12} {'samples':>8} {'seconds':>8} {'error':>9}"]
        rows += [
            f"{name:<12} {one.samples:>8} {one.seconds:>8.3f} {one.error:>9.3g}"
            for name, points in self.points.items()
            for one in points
        ]
        return "\n".join(rows)

    def _repr_png_(self) -> bytes:
        """Error over seconds, both on logarithmic scales."""
        from matplotlib.figure import Figure

        figure = Figure(figsize=(5.6, 3.6), layout="constrained")
        axes = figure.subplots()
        for (name, points), mark in zip(self.points.items(), "os^vDPX*<>" * 9, strict=False):
            seconds, errors = ([getattr(p, key) for p in points] for key in ("seconds", "error"))
            told = f"{name}, up to {points[-1].samples} a pixel"
            axes.loglog(seconds, errors, f"{mark}-", label=told, subs=(2, 5))
        # Matplotlib's own numbers between powers of ten would lie one over the other.
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter("{x:g}")
            axis.set_minor_formatter("{x:g}")
        axes.tick_params(which="both", labelsize=7)
        axes.set(title=self.title, xlabel="seconds", ylabel="root-mean-square error")
        axes.grid(alpha=0.3)
        axes.legend(title="samples")
        file = BytesIO()
        figure.savefig(file, format="png", dpi=DOTS)
        return file.getvalue()


def error_over_time(
    scene: Scene, *, seconds: float = 4.0, samplers: tuple[str, ...] = ()
) -> ErrorOverTime:
    """Measure how the error of a scene's pictures falls with the time that is spent.

    Raises CourseError: the scene's number of samples is its own, so that there is one error alone.

    Parameters
    ----------
    seconds : for all pictures of a sampler
    samplers : see ``render``; the scene's own if none is given
    """
    check_scene(scene, "error_over_time")
    settings = scene.settings
    fixed = settings.subdivision is not None or settings.denoise is not None
    names = samplers or (settings.sampler,)
    if fixed or not {*names} <= {*ADAPTABLE}:
        raise CourseError(
            f"{scene.title}: this scene's samples are placed all at once; "
            f"samplers= takes {', '.join(sorted(ADAPTABLE))}"
        )
    width = min(settings.width, WIDTH)
    size = width, max(round(settings.height * width / settings.width), 1)
    found: dict[str, tuple[ErrorPoint, ...]] = {}
    # The first picture of a scene makes its stages.
    render(scene, spp=1, size=size, progress=False)
    for name in names:
        end, points = monotonic() + seconds, list[ErrorPoint]()
        for power in count():
            spp, began = LONGER**power, monotonic()
            a, b = (
                render(scene, spp=spp, size=size, sampler=name, seed=seed, progress=False)
                for seed in (1, 2)
            )
            took = monotonic() - began
            if a.interrupted or b.interrupted:
                raise KeyboardInterrupt
            points.append(ErrorPoint(spp, took / 2, a.error(b) / math.sqrt(2)))
            if monotonic() + LONGER * took > end:
                break
        found[name] = tuple(points)
    return ErrorOverTime(scene.title, found)
