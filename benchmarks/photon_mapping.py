"""Light at a point by photons around it: how soon it is known with a radius that stays, and with one that shrinks.

The light is a spot that falls off like Gauss's curve, so that two numbers make a photon of it, and in its middle the
irradiance is 1. Photons come in passes. With a radius that stays the mean over the passes is that of a blurred spot; by
Knaus and Zwicker's radii ("Progressive photon mapping: a probabilistic approach", 2011) noise and blur both vanish.
"""

import math
from functools import partial

import numpy as np

from benchmarks.error_curves import Curve, error_curves, error_plot
from benchmarks.figures import Figure, summary
from benchmarks.quasi_monte_carlo import COUNTS, SEEDS, SETS
from benchmarks.report import report
from course.benchmarking.plot_data import Plot
from course.benchmarking.tables import Columns, table_of
from course.engine.functions.effects import PROJECT, Effects

WIDE, FIRST, PASS, CONE = 0.2, 0.2, 16, 1.1
"""The spot's standard deviation, the first radius, photons in a pass, and the filter's flatness."""

MODULE = Effects(PROJECT / "solutions")
cone_weights = MODULE.function("photon_mapping", "cone_weights")
shrunk_radius = MODULE.function("photon_mapping", "shrunk_radius")


def estimate(alpha: float, numbers: str, n: int, seed: int) -> float:
    """The irradiance in the middle, by n photons."""
    u = SETS[numbers](n, 2, seed)[0]
    # Only how far they are from the middle counts.
    far = (WIDE * np.sqrt(-2 * np.log1p(-u.astype(np.float64)))).astype(np.float32)
    passes = max(n // PASS, 1)
    radius, radii = np.full(1, FIRST, np.float32), []
    for i in range(1, passes + 1):
        radii.append(radius[0])
        radius = shrunk_radius(radius, np.array([i]), alpha)
    wide = np.repeat(np.array(radii, np.float32), -(-n // passes))[:n]
    weights = cone_weights(far, wide, CONE)
    # All photons of a pass have the power of the spot, and passes count alike.
    return float(2 * math.pi * WIDE**2 * weights.astype(np.float64).mean())


WAYS = {
    "radius stays": 1.0,
    "alpha = 0.9": 0.9,
    "alpha = 2/3": 2 / 3,
    "alpha = 0.3": 0.3,
}


def measure_photon_mapping() -> list[Figure]:
    """Errors over photons for each alpha, and how much smaller the last is where the radius shrinks."""
    ways = {name: partial(estimate, alpha, "random") for name, alpha in WAYS.items()}
    curves = error_curves(ways, 1.0, COUNTS, SEEDS)
    columns: Columns[Curve] = (
        ("radius", lambda curve: curve.name),
        ("RMSE", lambda curve: f"{curve.rmse[-1]:.2e}"),
        ("order", lambda curve: f"{curve.order.value:.2f}"),
    )
    told = table_of(f"Irradiance by {COUNTS[-1]:,} photons", curves, columns)
    plot: Plot = error_plot("spot", "light in the middle of a spot", curves, (4, 0, 1, 2))
    report("photon_mapping", f"{SEEDS} seeds", [told], [plot])
    stays, _, shrinks, _ = curves
    ratio = float((stays.rmse / shrinks.rmse)[-1])
    return [summary("photon_mapping: error, radius stays / shrinks", [ratio], 2, at_least=True)]
