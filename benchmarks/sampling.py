"""Points on the disk, in the ball and on the sphere: how many rejection keeps, and what they look like.

A square's points lie within its disk with probability pi / 4, a cube's within its ball with pi / 6. The figure,
`out/bench/sampling.svg`, shows points by rejection and by polar warps, and below them a popular mistake: radius and
angle uniform. `out/bench/data/sampling.json` has the error of a mean over the disk, for points by rejection and by the
polar warp of random, jittered and Sobol numbers: a warp carries evenness over, and rejection destroys it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.error_curves import error_curves, error_plot
from benchmarks.figures import Figure, summary
from benchmarks.quasi_monte_carlo import COUNTS, SEEDS, SETS
from benchmarks.report import OUT, report
from course.benchmarking.plot_data import Plot
from course.benchmarking.plots import COLORS, SOFT, STYLE, sheet, write
from course.benchmarking.tables import Columns, Table, table_of
from course.engine.core.types import Floats32
from course.engine.functions.effects import PROJECT, Effects

POINTS = 1_000_000
SHOWN = 700
"""Points of each panel."""

SLICE = 0.1
"""Points of the ball are shown as far from its middle plane."""

LIMIT = 4.5
"""Standard errors; a right rate is further off in one of 150,000 runs."""

MODULE = Effects(PROJECT / "solutions")
disk_by_rejection = MODULE.function("sampling", "disk_by_rejection")
disk_by_polar = MODULE.function("sampling", "disk_by_polar")
ball_by_rejection = MODULE.function("sampling", "ball_by_rejection")
ball_by_polar = MODULE.function("sampling", "ball_by_polar")
sphere_by_polar = MODULE.function("sampling", "sphere_by_polar")


@dataclass(frozen=True)
class Acceptance:
    """What became of a rejection's candidates."""

    name: str
    candidates: int
    inside: int
    expected: float

    @property
    def rate(self) -> float:
        """Share of the candidates that lie inside."""
        return self.inside / self.candidates

    @property
    def error(self) -> float:
        """Standard error of the rate."""
        return math.sqrt(self.expected * (1 - self.expected) / self.candidates)

    @property
    def off(self) -> float:
        """How far the rate is from what is expected, in standard errors."""
        return (self.rate - self.expected) / self.error


class _Recording(np.random.Generator):
    """A generator that remembers what it gave."""

    def __init__(self, seed: int) -> None:
        super().__init__(np.random.PCG64(seed))
        self.given: list[Any] = []

    def random(self, *args: Any, **kwargs: Any) -> Any:
        result = super().random(*args, **kwargs)
        self.given.append(result)
        return result


def measure_sampling() -> list[Figure]:
    """Report acceptance rates and errors, and draw the point sets."""
    rates = acceptances(POINTS)
    report("sampling", f"{SEEDS} seeds", [table(rates)], [errors(COUNTS, SEEDS)])
    print(f"written to {draw(OUT / 'sampling.svg', SHOWN)}")
    return [
        summary(
            f"sampling: {rate.name}, acceptance off by [standard errors]", [abs(rate.off)], LIMIT
        )
        for rate in rates
    ]


def acceptances(points: int) -> list[Acceptance]:
    """Of the candidates that each function draws for so many points, how many lie inside."""
    found = []
    for name, function, expected in (
        ("disk", disk_by_rejection, math.pi / 4),
        ("ball", ball_by_rejection, math.pi / 6),
    ):
        rng = _Recording(1)
        function(points, rng)
        candidates = 2 * np.concatenate(rng.given, axis=1).astype(np.float64) - 1
        inside = int(((candidates**2).sum(axis=0) <= 1).sum())
        found.append(Acceptance(name, candidates.shape[1], inside, expected))
    return found


def table(rates: list[Acceptance]) -> Table:
    """The rates, their standard errors, and what they should be."""
    names = {"disk": "π/4", "ball": "π/6"}
    columns: Columns[Acceptance] = (
        ("shape", lambda rate: rate.name),
        ("candidates", lambda rate: f"{rate.candidates:,}"),
        ("accepted", lambda rate: f"{rate.inside:,}"),
        ("rate", lambda rate: f"{rate.rate:.5f}"),
        ("standard error", lambda rate: f"{rate.error:.5f}"),
        ("expected", lambda rate: f"{names[rate.name]} = {rate.expected:.5f}"),
        ("off by", lambda rate: f"{rate.off:+.2f} standard errors"),
    )
    return table_of("Rejection: candidates that lie inside", rates, columns)


# ---------------------------------------------------------------- errors


def _by_rejection(n: int, seed: int) -> Floats32:
    return disk_by_rejection(n, np.random.default_rng(seed))


def _by_polar(numbers: str) -> Callable[[int, int], Floats32]:
    return lambda n, seed: disk_by_polar(SETS[numbers](n, 2, seed))


DISKS = {
    "rejection, random": _by_rejection,
    **{f"polar, {numbers}": _by_polar(numbers) for numbers in ("random", "jittered", "Sobol")},
}
"""Ways to points of the disk, (2, n) for n and a seed."""


def errors(counts: tuple[int, ...], seeds: int) -> Plot:
    """Errors of the mean of x^2 over the unit disk, which is 1/4, as the documentation's data files keep them.

    Seconds are those of one estimate, points and mean.
    """
    ways = {name: partial(_mean, points) for name, points in DISKS.items()}
    curves = error_curves(ways, 1 / 4, counts, seeds)
    return error_plot("disk", "the mean of x² over the disk", curves, (4, 0, 1, 2))


def _mean(points: Callable[[int, int], Floats32], n: int, seed: int) -> float:
    return float((points(n, seed)[0].astype(np.float64) ** 2).mean())


# ---------------------------------------------------------------- the figure


@dataclass(frozen=True)
class Panel:
    """A point set.

    Attributes
    ----------
    make : (dims, n) points for n and a generator
    inner : the share of points in the inner part that is told below, as it is expected of the set
    """

    title: str
    shape: str
    make: Callable[[int, np.random.Generator], Floats32]
    inner: float


def _sphere_by_rejection(n: int, rng: np.random.Generator) -> Floats32:
    points = ball_by_rejection(n, rng)
    return points / np.linalg.norm(points, axis=0)


def _even_radius_disk(n: int, rng: np.random.Generator) -> Floats32:
    radius, turn = rng.random((2, n))
    return radius * np.stack((np.cos(2 * np.pi * turn), np.sin(2 * np.pi * turn)))


def _even_radius_ball(n: int, rng: np.random.Generator) -> Floats32:
    return rng.random(n) * sphere_by_polar(rng.random((2, n), np.float32))


def _even_angle_sphere(n: int, rng: np.random.Generator) -> Floats32:
    angle, turn = np.pi * rng.random(n), 2 * np.pi * rng.random(n)
    ring = np.sin(angle)
    return np.stack((ring * np.cos(turn), ring * np.sin(turn), np.cos(angle)))


CAPS = 1 - math.sqrt(3) / 2
"""Area of the caps of 30 degrees around both poles, as a share of the sphere's."""

PANELS = (
    (
        Panel("by rejection", "disk", disk_by_rejection, 1 / 4),
        Panel("by rejection", "ball", ball_by_rejection, 1 / 8),
        Panel("by rejection, then normalised", "sphere", _sphere_by_rejection, CAPS),
    ),
    (
        Panel("polar", "disk", lambda n, rng: disk_by_polar(rng.random((2, n))), 1 / 4),
        Panel("polar", "ball", lambda n, rng: ball_by_polar(rng.random((3, n))), 1 / 8),
        Panel("polar", "sphere", lambda n, rng: sphere_by_polar(rng.random((2, n))), CAPS),
    ),
    (
        Panel("mistake: without the square root", "disk", _even_radius_disk, 1 / 2),
        Panel("mistake: without the cube root", "ball", _even_radius_ball, 1 / 2),
        Panel("mistake: uniform angle", "sphere", _even_angle_sphere, 1 / 3),
    ),
)
COLUMNS = {
    "disk": "Disk",
    "ball": f"Ball, slice |z| < {SLICE:g}",
    "sphere": "Sphere, unrolled: height over longitude",
}
INNER = {
    "disk": "within half the radius",
    "ball": "within half the radius",
    "sphere": "within 30° of a pole",
}


def inner_share(shape: str, points: Floats32) -> float:
    """Share of points (dims, n) within half the radius, or for a sphere within 30 degrees of a pole."""
    if shape == "sphere":
        return float((np.abs(points[2]) > math.cos(math.pi / 6)).mean())
    return float((np.linalg.norm(points, axis=0) < 0.5).mean())


def draw(path: Path, shown: int) -> Path:
    """Draw nine panels of that many points each."""
    from matplotlib import rc_context

    with rc_context(STYLE):
        about = f"{shown} points in each panel; below it the share of 100,000 points, and what is expected"
        figure = sheet("Uniform points, and points that are not", about, (13, 12))
        for row, panels in enumerate(PANELS):
            for column, panel in enumerate(panels):
                left, width = (0.03, 0.29, 0.57)[column], (0.22, 0.22, 0.40)[column]
                axes = figure.add_axes((left, 0.655 - 0.305 * row, width, 0.205))
                rng = np.random.default_rng(10 * row + column + 1)
                points = panel.make(100_000, rng)
                _scatter(axes, panel.shape, points, shown)
                heading = f"{COLUMNS[panel.shape]}\n{panel.title}"
                color = COLORS[0] if row == 2 else "black"
                axes.set_title(heading, fontsize=13, color=color)
                share = inner_share(panel.shape, points)
                text = f"{INNER[panel.shape]}: {share:.3f} ({panel.inner:.3f})"
                axes.text(
                    0.5, -0.03, text, transform=axes.transAxes, ha="center", va="top", fontsize=12
                )
        return write(figure, path)


def _scatter(axes: Any, shape: str, points: Floats32, shown: int) -> None:
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)
    if shape == "sphere":
        x, y = np.degrees(np.arctan2(points[1], points[0])), points[2]
        axes.set(xlim=(-180, 180), ylim=(-1, 1))
        for spine in axes.spines.values():
            spine.set_visible(True)
            spine.set_color(SOFT)
    else:
        if shape == "ball":
            points = points[:, np.abs(points[2]) < SLICE]
        x, y = points[:2]
        turn = np.linspace(0, 2 * np.pi, 181)
        axes.plot(np.cos(turn), np.sin(turn), color=SOFT, linewidth=1)
        axes.set(xlim=(-1.03, 1.03), ylim=(-1.03, 1.03), aspect="equal")
    axes.plot(x[:shown], y[:shown], ".", color=COLORS[1], markersize=2.6)
