"""Error over the number of points: random, jittered, Sobol, Hammersley, Halton, and patterns chained by ids.

Three integrals whose values are known: the area of a disk, a smooth function of two numbers, and a product of six, as
a path takes them: two each for the pixel, the lens and the light. Every point set is drawn anew for each seed, so that
an error can be told from luck: Hammersley's and Halton's points, and the patterns, are shifted by a random number
modulo 1 in each dimension; Sobol's are the renderer's own, scrambled. In six dimensions jittered points are stratified
pair by pair, the pairs in random order. Times are of one estimate: points and mean.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import count

import numpy as np

from benchmarks.error_curves import Curve, error_curves, error_plot
from benchmarks.figures import Figure
from benchmarks.report import report
from course.benchmarking.plot_data import Plot
from course.benchmarking.tables import Columns, Table, digits, order_with_interval, table_of
from course.engine.core.samplers import Block
from course.engine.core.types import Floats32, Floats64
from course.engine.functions.effects import PROJECT, Effects
from course.engine.terms.samplers.sobol import SobolSampler

COUNTS = tuple(4**power for power in range(2, 8))
"""Numbers of points: squares for the jittered ones, and powers of 2 for the others."""

SEEDS = 64
STRETCH = 1024
COMMON = 1024

MODULE = Effects(PROJECT / "solutions")
halton = MODULE.function("quasi_monte_carlo", "halton")
hammersley = MODULE.function("quasi_monte_carlo", "hammersley")
radical_inverse = MODULE.function("quasi_monte_carlo", "radical_inverse")
chain = MODULE.function("quasi_monte_carlo", "chain")
random = MODULE.function("supersampling", "random")
jittered = MODULE.function("supersampling", "jittered")

Points = Callable[[int, int, int], Floats32]
"""(dims, n) for n, dims and a seed."""


@dataclass(frozen=True)
class Integral:
    """A mean over the unit cube.

    Attributes
    ----------
    f : of points (dims, n) float64
    value : of the mean
    """

    name: str
    title: str
    dims: int
    f: Callable[[Floats64], Floats64]
    value: float


INTEGRALS = (
    Integral("disk", "a disk's area", 2, lambda x: ((2 * x - 1) ** 2).sum(axis=0) < 1, math.pi / 4),
    Integral(
        "smooth",
        "a smooth function, exp(x + y)",
        2,
        lambda x: np.exp(x.sum(axis=0)),
        (math.e - 1) ** 2,
    ),
    Integral(
        "path",
        "a product of six, as of pixel, lens and light",
        6,
        lambda x: (math.pi / 2 * np.sin(math.pi * x)).prod(axis=0),
        1.0,
    ),
)


def measure_quasi_monte_carlo() -> list[Figure]:
    """Report the errors; the fitted orders with their intervals."""
    measured = [(integral, measure(integral, COUNTS, SEEDS)) for integral in INTEGRALS]
    report(
        "quasi_monte_carlo",
        f"{SEEDS} seeds",
        [table(*each) for each in measured],
        [plot(*each) for each in measured],
    )
    return [
        Figure(
            f"{integral.title}: order of {curve.name}",
            curve.order.value,
            curve.order.low,
            curve.order.high,
            GOALS[integral.name].get(curve.name, -0.45),
        )
        for integral, curves in measured
        for curve in curves
    ]


GOALS = {
    "disk": {"jittered": -0.7, "Sobol": -0.65, "Hammersley": -0.65, "Halton": -0.6},
    "smooth": {"jittered": -0.9, "Sobol": -1.2, "Hammersley": -0.85, "Halton": -0.85},
    "path": {"Hammersley": -0.7, "Halton": -0.7},
}
"""Orders to be reached, at most; -0.45 where nothing better than random points is promised."""


# ---------------------------------------------------------------- point sets


def _random(n: int, dims: int, seed: int) -> Floats32:
    side = math.isqrt(n)
    rng = np.random.default_rng(seed)
    pairs = [random(side, 1, rng)[:, 0] for _ in range(dims // 2)]
    return np.concatenate(pairs)


def _jittered(n: int, dims: int, seed: int) -> Floats32:
    side = math.isqrt(n)
    rng = np.random.default_rng(seed)
    pairs = [jittered(side, 1, rng)[:, 0] for _ in range(dims // 2)]
    return np.concatenate([pairs[0], *(rng.permutation(pair, axis=1) for pair in pairs[1:])])


def _sobol(n: int, dims: int, seed: int) -> Floats32:
    """The renderer's own, of a pixel of that number, in stretches no longer than the renderer asks for."""
    pixel, sampler = np.array([seed], np.uint32), SobolSampler(1)
    length = min(n, STRETCH)
    stretches = [Block(pixel, first, length, 0) for first in range(0, n, length)]
    return np.concatenate([sampler.draw(block, 0, dims) for block in stretches], axis=1)


def _hammersley(n: int, dims: int, seed: int) -> Floats32:
    return shifted(hammersley(n, dims), np.random.default_rng(seed))


def _halton(n: int, dims: int, seed: int) -> Floats32:
    return shifted(halton(np.arange(n), dims), np.random.default_rng(seed))


def _chained(n: int, dims: int, seed: int) -> Floats32:
    """Six dimensions as three patterns of pairs; two as two patterns of one dimension each."""
    rng = np.random.default_rng(seed)
    ids = np.arange(n)
    alike = [radical_inverse(2, ids)[None]] * 2 if dims == 2 else [hammersley(n, 2)] * (dims // 2)
    patterns = [shifted(pattern, rng) for pattern in alike]
    return np.concatenate(chain(patterns, ids, rng))


def shifted(points: Floats32, rng: np.random.Generator) -> Floats32:
    """Points (dims, n) moved by one random vector, modulo 1: each is uniform then, and they are as even as before."""
    moved: Floats32 = (points + rng.random((len(points), 1))) % 1.0
    return moved


SETS: dict[str, Points] = {
    "random": _random,
    "jittered": _jittered,
    "Sobol": _sobol,
    "Hammersley": _hammersley,
    "Halton": _halton,
    "chained ids": _chained,
}


# ---------------------------------------------------------------- measurements


def measure(integral: Integral, counts: tuple[int, ...], seeds: int) -> list[Curve]:
    """Errors of every point set."""
    ways = {name: partial(_mean, integral, points) for name, points in SETS.items()}
    return error_curves(ways, integral.value, counts, seeds)


def _mean(integral: Integral, points: Points, n: int, seed: int) -> float:
    return float(integral.f(points(n, integral.dims, seed).astype(np.float64)).mean())


def table(integral: Integral, curves: list[Curve]) -> Table:
    """Errors and orders."""

    def rmse_at(count: int) -> Callable[[Curve], str]:
        return lambda curve: digits(float(curve.rmse[COUNTS.index(count)]))

    columns: Columns[Curve] = (
        ("points", lambda curve: curve.name),
        *((f"RMSE, {count:,}", rmse_at(count)) for count in (64, COMMON, COUNTS[-1])),
        ("order (95% interval)", lambda curve: order_with_interval(curve.order)),
    )
    title = f"The mean of {integral.title}, {integral.value:.5f}; {SEEDS} seeds"
    return table_of(title, curves, columns)


def plot(integral: Integral, curves: list[Curve]) -> Plot:
    """The errors as the documentation's data files keep them."""
    return error_plot(integral.name, f"points for {integral.title}", curves, count())
