"""What division by contrast saves: camera rays at equal error, spread evenly over those through corners.

Rays are counted, and renders are timed beside them, in turn. Evenly spread are k x k cell centres in every pixel, and
Sobol points; their errors against a converged picture say how many rays they would need for the error that division
leaves. Once for the scene as it is, whose wires pass between corners unseen, and once without its wires.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from benchmarks.figures import Figure, summary
from benchmarks.report import report
from course import Picture, Scene, load_scene, render
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import NONE, Table, digits
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT
from course.engine.loops.embree_device import available
from course.engine.scene.scene import load_variant

SCENE = PROJECT / "scenes" / "adaptive_sampling.yaml"
THREADS = 2
THIN = "wire"
"""The material of what is missed."""

GOALS = {"wires": {2: 3.0, 3: 2.0}, "edges": {2: 4.0, 3: 5.0}}
"""Rays of the grid over those of the divided picture, by depth; at the least."""


@dataclass(frozen=True)
class Effort:
    """Size of the pictures, samples of the converged one, what is compared, and how often each render is timed."""

    size: tuple[int, int] = (240, 180)
    reference: int = 1024
    depths: tuple[int, ...] = (0, 1, 2, 3, 4, 5)
    thresholds: tuple[float, ...] = (0.4, 0.1, 0.025)
    even: tuple[int, ...] = (1, 4, 16, 64, 256)
    rounds: int = 5


@dataclass(frozen=True)
class Point:
    """A picture: camera rays a pixel, its root-mean-square error, and the median seconds of its renders."""

    rays: float
    error: float
    seconds: float


@dataclass(frozen=True)
class Division:
    """A divided picture, and the rays a pixel that evenly spread ones would need for its error.

    Attributes
    ----------
    saved : part of the corners of the smallest cells that got no rays
    regular, sobol : NaN where more rays would be needed than were tried
    """

    threshold: float
    depth: int
    point: Point
    saved: float
    regular: float
    sobol: float


@dataclass(frozen=True)
class Measured:
    """What was found in one scene."""

    regular: list[Point]
    sobol: list[Point]
    divisions: list[Division]


def measure_adaptive_sampling() -> list[Figure]:
    """Report the errors over rays; the rays saved at the scene's own threshold and depth."""
    division = load_scene(SCENE).settings.subdivision
    assert division is not None
    effort = Effort()
    titles = {"wires": "with its wires", "edges": "without its wires"}
    measured = {name: measure(name == "wires", effort) for name in titles}
    width, height = effort.size
    report(
        "adaptive_sampling",
        f"{width} x {height} pixels, each render timed {effort.rounds} times",
        [table(found, titles[name]) for name, found in measured.items()],
        [plot(name, titles[name], found) for name, found in measured.items()],
    )
    figures = []
    for name, found in measured.items():
        gains = {
            one.depth: one.regular / one.point.rays
            for one in found.divisions
            if one.threshold == division.threshold
        }
        for depth, goal in GOALS[name].items():
            label = f"division {titles[name]}, depth {depth}: rays, even grid / divided"
            figures.append(summary(label, [gains[depth]], goal, at_least=True))
    return figures


def measure(thin: bool, effort: Effort) -> Measured:
    """Even and divided pictures of the scene, with what is thin or without."""
    even = _scene(thin, None)
    reference = _render(even, effort, spp=effort.reference, sampler="sobol", seed=99)
    ideal = reference.linear.astype(np.float64)
    spread = [(sampler, spp) for sampler in ("regular", "sobol") for spp in effort.even]
    divided = [(threshold, depth) for threshold in effort.thresholds for depth in effort.depths]
    renders = [partial(_render, even, effort, spp=spp, sampler=sampler) for sampler, spp in spread]
    renders += [
        partial(_render, _scene(thin, {"threshold": threshold, "depth": depth}), effort)
        for threshold, depth in divided
    ]
    # The first of each makes tables and Embree's tree, and isn't timed.
    pictures = [again() for again in renders]
    seconds = _median_seconds(renders, effort.rounds)
    points = [_point(*each, ideal) for each in zip(pictures, seconds, strict=True)]

    regular, sobol = points[: len(effort.even)], points[len(effort.even) : len(spread)]
    divisions = []
    for (threshold, depth), picture, point in zip(
        divided, pictures[len(spread) :], points[len(spread) :], strict=True
    ):
        told = picture.receipt.subdivision
        assert told is not None
        equal = rays_for(point.error, regular), rays_for(point.error, sobol)
        divisions.append(Division(threshold, depth, point, told["saved"], *equal))
    return Measured(regular, sobol, divisions)


def _render(scene: Scene, effort: Effort, **how: Any) -> Picture:
    # Always or never: left to itself, a render decides by what was rendered before.
    return render(scene, size=effort.size, threads=THREADS, compiled=available(), **how)


def _median_seconds(renders: Sequence[Callable[[], Picture]], rounds: int) -> list[float]:
    """Of every render, all in turn within each round."""
    seconds = [[again().receipt.wall_seconds for again in renders] for _ in range(rounds)]
    return [float(median) for median in np.median(seconds, axis=0)]


def _point(picture: Picture, seconds: float, ideal: Floats64) -> Point:
    error = math.sqrt(float(((picture.linear - ideal) ** 2).mean()))
    return Point(picture.receipt.rays["camera"] / picture.receipt.pixels, error, seconds)


def _scene(thin: bool, division: dict[str, float] | None) -> Scene:
    scene = load_scene(SCENE)
    things = scene.loaded.document.data["objects"]
    kept = [thing for thing in things if thin or thing["material"] != THIN]
    return load_variant(SCENE, {("film", "subdivision"): division, ("objects",): kept})


def rays_for(error: float, curve: list[Point]) -> float:
    """Rays a pixel at which a falling curve reaches an error, on straight lines between its points in logarithms.

    NaN where the error is below the curve's last, and the first point's rays where it is above the first.
    """
    x, y = np.log([point.rays for point in curve]), np.log([point.error for point in curve])
    if math.log(error) < y[-1]:
        return math.nan
    return float(np.exp(np.interp(-math.log(error), -y, x)))


def table(found: Measured, title: str) -> Table:
    """A row for each threshold and depth."""
    columns = (
        "threshold",
        "depth",
        "rays a pixel",
        "RMSE",
        "of the lattice",
        "k x k grid",
        "times",
        "Sobol",
        "times",
    )
    most = max(point.rays for point in found.regular)
    rows = []
    for one in found.divisions:
        cells = [f"{one.threshold:g}", f"{one.depth}", f"{one.point.rays:.2f}"]
        cells += [digits(one.point.error), f"{1 - one.saved:.1%}"]
        for equal in (one.regular, one.sobol):
            reached = not math.isnan(equal)
            cells += [f"{equal:.1f}" if reached else f"> {most:g}"]
            cells += [f"{equal / one.point.rays:.1f}" if reached else NONE]
        rows.append(tuple(cells))
    about = f"The scene {title}: camera rays a pixel, and how many spread evenly for the same error"
    return Table(about, columns, tuple(rows))


def plot(name: str, title: str, found: Measured) -> Plot:
    """Error over camera rays a pixel and over seconds, as the documentation's data files keep it."""
    series = tuple(
        Series(
            name,
            style,
            {
                "samples": tuple(point.rays for point in points),
                "seconds": tuple(point.seconds for point in points),
            },
            tuple(point.error for point in points),
        )
        for name, points, style in _named(found)
    )
    axes = {"samples": "camera rays a pixel", "seconds": "seconds"}
    return Plot(name, f"division by contrast, the scene {title}", axes, "RMSE", series)


def _named(found: Measured) -> list[tuple[str, list[Point], int]]:
    """Curves with their names and styles: the two that are even, and one for each threshold."""
    curves = [("k x k grid", found.regular, 3), ("Sobol", found.sobol, 2)]
    thresholds = list(dict.fromkeys(one.threshold for one in found.divisions))
    for style, threshold in zip((0, 1, 4, 5), thresholds, strict=False):
        points = [one.point for one in found.divisions if one.threshold == threshold]
        curves.append((f"divided over {threshold:g}", points, style))
    return curves
