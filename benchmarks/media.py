"""Light that fog scatters into a ray that passes a lamp: how soon it is known by three ways to choose places on it.

The ray is 4 units long, and the lamp stands a tenth of a unit beside its middle. Places are chosen evenly, as dense as
the fog loses light, or by equal angles seen from the lamp (Kulla and Fajardo, "Importance sampling techniques for path
tracing in participating media", 2012). The value is by Gauss and Legendre's quadrature over the angle.
"""

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from benchmarks.error_curves import Curve, error_curves, error_plot
from benchmarks.figures import Figure, summary
from benchmarks.quasi_monte_carlo import COUNTS, SEEDS, SETS
from benchmarks.report import report
from course.benchmarking.plot_data import Plot
from course.benchmarking.tables import Columns, table_of
from course.engine.core.types import Floats32
from course.engine.functions.effects import PROJECT, Effects

LENGTH, ASIDE, EXTINCTION, ALBEDO = 4.0, 0.1, 0.3, 0.9
MODULE = Effects(PROJECT / "solutions")
equiangular = MODULE.function("media", "equiangular")
in_scattering = MODULE.function("media", "in_scattering")

Places = Callable[[Floats32], tuple[Floats32, Floats32]]
"""From numbers (n,) to distances (n,) and their densities (n,)."""


def _evenly(u: Floats32) -> tuple[Floats32, Floats32]:
    return LENGTH * u, np.full_like(u, 1 / LENGTH)


def _by_loss(u: Floats32) -> tuple[Floats32, Floats32]:
    lost = -math.expm1(-EXTINCTION * LENGTH)
    distance = -np.log1p(-u * lost) / EXTINCTION
    return distance, EXTINCTION * np.exp(-EXTINCTION * distance) / lost


def _by_angle(u: Floats32) -> tuple[Floats32, Floats32]:
    n = len(u)
    origin, direction, lamp = np.zeros((3, 3, n), np.float32)
    direction[2], lamp[0], lamp[2] = 1, ASIDE, LENGTH / 2
    found: tuple[Floats32, Floats32] = equiangular(
        origin, direction, lamp, np.full(n, LENGTH, np.float32), u
    )
    return found


def _beyond(distance: Floats32) -> Floats32:
    return np.hypot(distance - LENGTH / 2, ASIDE)


def estimate(places: Places, numbers: str, n: int, seed: int) -> float:
    """The light of a lamp of intensity 1, by n places."""
    distance, density = places(SETS[numbers](n, 2, seed)[0])
    sigma_t = np.full(3, EXTINCTION, np.float32)
    beyond = _beyond(distance)
    phase = np.full(n, 1 / (4 * math.pi), np.float32)
    sigma_s = np.float32(ALBEDO) * sigma_t
    radiance = in_scattering(sigma_s, sigma_t, distance, beyond, phase, density)
    return float((radiance[0].astype(np.float64) / beyond.astype(np.float64) ** 2).mean())


def value() -> float:
    """The same, exact to 1e-12."""
    x, weights = np.polynomial.legendre.leggauss(200)
    widest = math.atan(LENGTH / 2 / ASIDE)
    distance = LENGTH / 2 + ASIDE * np.tan(widest * x)
    # dt = d^2 / ASIDE d(angle), which is what 1 / d^2 cancels.
    left = np.exp(-EXTINCTION * (distance + np.hypot(distance - LENGTH / 2, ASIDE)))
    share = ALBEDO * EXTINCTION / (4 * math.pi)
    return float(share * widest / ASIDE * (weights * left).sum())


WAYS = {
    "evenly": (_evenly, "random"),
    "as light is lost": (_by_loss, "random"),
    "equal angles": (_by_angle, "random"),
    "equal angles, Sobol": (_by_angle, "Sobol"),
}


def measure_media() -> list[Figure]:
    """Errors over places by each way, and how many more places the other ways take than equal angles."""
    ways = {name: partial(estimate, *way) for name, way in WAYS.items()}
    curves = error_curves(ways, value(), COUNTS, SEEDS)
    columns: Columns[Curve] = (
        ("places chosen", lambda curve: curve.name),
        ("RMSE / value", lambda curve: f"{curve.rmse[-1] / value():.2e}"),
        ("order", lambda curve: f"{curve.order.value:.2f}"),
    )
    told = table_of(f"In-scattered light, {COUNTS[-1]:,} places", curves, columns)
    plot: Plot = error_plot("ray", "light scattered into a ray", curves, (4, 0, 1, 2))
    report("media", f"{SEEDS} seeds", [told], [plot])
    evenly, _, angles, _ = curves
    ratio = float((evenly.mse.mean(axis=1) / angles.mse.mean(axis=1))[-1])
    return [
        summary(
            "media: places for the same error, evenly / by equal angles", [ratio], 10, at_least=True
        )
    ]
