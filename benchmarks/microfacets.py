"""What a perfect metal returns of an uneven sky, seen at 80 degrees: by visible normals, and by all normals.

Both draw microfacets, with their densities by the functions of the module: one by `sample_visible_normal`, the other by
D cos, whose normals are drawn by inversion. Seconds are those of the draws and of their weights, at best; both take
their turn in each batch.
"""

from collections.abc import Callable
from time import perf_counter

import numpy as np

from benchmarks.figures import Figure
from benchmarks.report import report
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import Table
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT, Effects

MODULE = Effects(PROJECT / "solutions")
sample_visible_normal = MODULE.function("microfacets", "sample_visible_normal")
visible_normal_pdf = MODULE.function("microfacets", "visible_normal_pdf")
smith_g1 = MODULE.function("microfacets", "smith_g1")
smith_g2 = MODULE.function("microfacets", "smith_g2")

ALPHA = 0.4
DEGREES = 80
SHOWN = tuple(4**power for power in range(2, 8))
PARTS = 8
"""Of the batches, for the range of a ratio."""

BATCHES = 128 * PARTS
EXACT = 10, 4_000_000
"""Samples of the reference, in so many parts: fewer would add an error of its own."""

SAMPLES_GOAL = 10.0

Draw = Callable[[Floats64, Floats64], Floats64]


def _view(n: int) -> Floats64:
    angle = np.radians(DEGREES)
    return np.repeat([[np.sin(angle)], [0.0], [np.cos(angle)]], n, axis=1)


def _sky(direction: Floats64) -> Floats64:
    """Radiance: bright to one side, and never 0."""
    found: Floats64 = 1 + 0.5 * direction[0] + 0.3 * direction[1]
    return found


def by_visible_normals(wo: Floats64, u: Floats64) -> Floats64:
    """What each sample says, (n,): the sky times G2 / G1."""
    wm = sample_visible_normal(wo, ALPHA, u)
    wi = 2 * (wo * wm).sum(axis=0) * wm - wo
    said: Floats64 = _sky(wi) * smith_g2(wo[2], wi[2], ALPHA) / smith_g1(wo[2], ALPHA)
    return said


def by_all_normals(wo: Floats64, u: Floats64) -> Floats64:
    """What each sample says, (n,): the sky times G2 dot(wo, wm) / (wo_z wm_z)."""
    tangent = ALPHA * np.sqrt(u[0] / (1 - u[0]))
    phi = 2 * np.pi * u[1]
    z = 1 / np.hypot(1, tangent)
    wm = np.stack((z * tangent * np.cos(phi), z * tangent * np.sin(phi), z))
    slant = (wo * wm).sum(axis=0)
    wi = 2 * slant * wm - wo
    weight = smith_g2(wo[2], wi[2], ALPHA) * np.maximum(slant, 0) / (wo[2] * z)
    said: Floats64 = _sky(wi) * weight
    return said


WAYS: dict[str, Draw] = {"visible normals": by_visible_normals, "all normals": by_all_normals}


def measure_microfacets() -> list[Figure]:
    """Measure, print and draw the curves; what visible normals gain at equal samples and in equal time."""
    rng = np.random.default_rng(1)
    parts, each = EXACT
    exact = float(
        np.mean(
            [by_visible_normals(_view(each), rng.random((2, each))).mean() for _ in range(parts)]
        )
    )
    squares, seconds = _estimates(exact, rng)
    lines, rows = [], []
    for style, name in enumerate(WAYS):
        # The fastest run is the one that others disturbed least.
        errors, times = np.sqrt(squares[style].mean(axis=1)), seconds[style].min(axis=1)
        axes = {"samples": SHOWN, "seconds": tuple(times.tolist())}
        lines.append(Series(name, style, axes, tuple(errors.tolist())))
        rows.append((name, f"{errors[-1]:.2e}", f"{errors[-1] ** 2 * times[-1]:.2e}"))
    title = f"a perfect metal of alpha {ALPHA}, seen at {DEGREES} degrees"
    plot = Plot(
        "normals", title, {"samples": "samples", "seconds": "seconds"}, "RMSE", tuple(lines)
    )
    columns = "normals", f"RMSE of {SHOWN[-1]} samples", "squared, times seconds"
    about = f"{BATCHES} estimates of each number of samples"
    report("microfacets", about, [Table(title, columns, tuple(rows))], [plot])
    return [
        _gain("samples for the same error", squares, np.ones_like(seconds), SAMPLES_GOAL),
        _gain("seconds for the same error", squares, seconds, 1.0),
    ]


def _estimates(exact: float, rng: np.random.Generator) -> tuple[Floats64, Floats64]:
    """Squared errors and seconds (ways, counts, BATCHES) of estimates, each way in turn."""
    squares = np.empty((len(WAYS), len(SHOWN), BATCHES))
    seconds = np.empty_like(squares)
    for row, count in enumerate(SHOWN):
        wo = _view(count)
        for batch in range(BATCHES):
            for way, draw in enumerate(WAYS.values()):
                u = rng.random((2, count))
                begun = perf_counter()
                said = draw(wo, u).mean()
                seconds[way, row, batch] = perf_counter() - begun
                squares[way, row, batch] = (said - exact) ** 2
    return squares, seconds


def _gain(what: str, squares: Floats64, seconds: Floats64, goal: float) -> Figure:
    """How many times as much all normals take as visible ones, of the most samples; the range is that of PARTS."""
    parts = squares[:, -1].reshape(len(WAYS), PARTS, -1).mean(axis=2)
    times = np.median(seconds[:, -1], axis=1)[:, None]
    visible, normals = parts.mean(axis=1) * times[:, 0]
    least, most = parts * times
    each = most / least
    name = f"microfacets: {what}, all normals / visible ones"
    ratio = float(normals / visible)
    return Figure(name, ratio, float(each.min()), float(each.max()), goal, at_least=True)
