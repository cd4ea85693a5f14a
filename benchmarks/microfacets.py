"""What a perfect metal returns of an uneven sky, seen at 80 degrees: by visible normals, and by all normals.

Both draw microfacets, with their densities by the functions of the module: one by `sample_visible_normal`, the other by
D cos, whose normals are drawn by inversion. Seconds are those of the draws and of their weights, at best.
"""

import time
from collections.abc import Callable

import numpy as np

from benchmarks.figures import Figure
from benchmarks.report import report
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import Table
from course.core.types import Floats64
from course.effects import PROJECT, Effects

MODULE = Effects(PROJECT / "solutions")
sample_visible_normal = MODULE.function("microfacets", "sample_visible_normal")
visible_normal_pdf = MODULE.function("microfacets", "visible_normal_pdf")
smith_g1 = MODULE.function("microfacets", "smith_g1")
smith_g2 = MODULE.function("microfacets", "smith_g2")

ALPHA = 0.4
DEGREES = 80
SHOWN = tuple(4**power for power in range(2, 8))
BATCHES = 256
EXACT = 4_000_000
"""Samples of the reference."""

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
    """Measure, print and draw the curves."""
    rng = np.random.default_rng(1)
    exact = float(by_visible_normals(_view(EXACT), rng.random((2, EXACT))).mean())
    lines, rows = [], []
    for style, (name, draw) in enumerate(WAYS.items()):
        errors, seconds = zip(*(_error(draw, count, exact, rng) for count in SHOWN), strict=True)
        lines.append(Series(name, style, {"samples": SHOWN, "seconds": seconds}, errors))
        cells = f"{errors[-1]:.2e}", f"{errors[-1] ** 2 * seconds[-1]:.2e}"
        rows.append((name, *cells))
    print(f"{lines[1].y[-1] ** 2 / lines[0].y[-1] ** 2:.1f} times the samples for the same error")
    title = f"a perfect metal of alpha {ALPHA}, seen at {DEGREES} degrees"
    axes = {"samples": "samples", "seconds": "seconds"}
    plot = Plot("normals", title, axes, "RMSE", tuple(lines))
    columns = "normals", f"RMSE of {SHOWN[-1]} samples", "squared, times seconds"
    about = f"{BATCHES} estimates of each number of samples"
    report("microfacets", about, [Table(title, columns, tuple(rows))], [plot])
    return []


def _error(draw: Draw, count: int, exact: float, rng: np.random.Generator) -> tuple[float, float]:
    """Of an estimate by that many samples, and the seconds that it takes."""
    wo, means, taken = _view(count), np.empty(BATCHES), np.empty(BATCHES)
    for batch in range(BATCHES):
        u = rng.random((2, count))
        begun = time.perf_counter()
        means[batch] = draw(wo, u).mean()
        taken[batch] = time.perf_counter() - begun
    # The fastest run is the one that others disturbed least.
    return float(np.sqrt(((means - exact) ** 2).mean())), float(taken.min())
