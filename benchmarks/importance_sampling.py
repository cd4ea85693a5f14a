"""Two integrals over the hemisphere, each by uniform, cosine-weighted and Phong-lobe directions, and by two combined.

The first is that of cos^3, for which any density will do, some better. The second is matt with a highlight: the lobe
fits the highlight and all but misses the rest, so alone it has no finite variance; with cosine-weighted directions,
weighted by the power heuristic, it beats both. Variances are predicted from the densities, and measured.
`out/bench/importance_sampling_cube.svg` and `importance_sampling_highlight.svg` show densities beside errors.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.error_curves import median_seconds
from benchmarks.figures import Figure, summary
from benchmarks.report import OUT, report
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.plots import COLORS, STYLE, draw_lines, sheet, write
from course.benchmarking.tables import NONE, Table
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT, Effects

MODULE = Effects(PROJECT / "solutions")
uniform_hemisphere = MODULE.function("importance_sampling", "uniform_hemisphere")
cosine_hemisphere = MODULE.function("importance_sampling", "cosine_hemisphere")
cosine_hemisphere_pdf = MODULE.function("importance_sampling", "cosine_hemisphere_pdf")
phong_lobe_pdf = MODULE.function("importance_sampling", "phong_lobe_pdf")
power_heuristic = MODULE.function("importance_sampling", "power_heuristic")
estimate = MODULE.function("importance_sampling", "estimate")
sample_phong_lobe = MODULE.function("glossy", "sample_phong_lobe")

BATCHES = 256
SAMPLES = 16384
"""Of each batch; a batch gives one estimate of the integral and one of the variance."""

SHOWN = tuple(4**power for power in range(2, 8))
LIMIT = 4.5
"""Standard errors; a right ratio is further off in one of 150,000 runs."""

ROUNDS = 64
"""How often an estimate is timed."""

Numbers = Callable[[Floats64], Floats64]
Draw = Callable[[int, np.random.Generator], tuple[float, float]]
"""Takes a number of samples; returns the estimate and its variance."""


@dataclass(frozen=True)
class Integrand:
    """f(cos) = matt * cos + lobe * cos^exponent, and a Phong lobe to sample it with.

    Attributes
    ----------
    name : of the figure's file
    title : as people write it
    lobe_exponent : of the Phong lobe; the variance is finite below 3, or below 2 exponent + 1 where nothing is matt
    """

    name: str
    title: str
    matt: float
    lobe: float
    exponent: int
    lobe_exponent: int

    def __call__(self, cos: Floats64) -> Floats64:
        """The integrand at each cosine."""
        return self.matt * cos + self.lobe * cos**self.exponent

    @property
    def value(self) -> float:
        """The integral over the hemisphere."""
        return 2 * math.pi * (self.matt / 2 + self.lobe / (self.exponent + 1))

    def squared(self, less: int) -> float:
        """The integral of f^2 / cos^less over cos from 0 to 1; infinite where it diverges."""
        n = self.exponent
        terms = (
            (self.matt**2, 3 - less),
            (2 * self.matt * self.lobe, n + 2 - less),
            (self.lobe**2, 2 * n + 1 - less),
        )
        if any(factor and power <= 0 for factor, power in terms):
            return math.inf
        return sum(factor / power for factor, power in terms if factor)


CUBE = Integrand("cube", "cos³", 0.0, 1.0, 3, 2)
HIGHLIGHT = Integrand("highlight", "cos + 8 cos⁵⁰", 1.0, 8.0, 50, 50)


@dataclass(frozen=True)
class Measured:
    """One way to sample an integral.

    Attributes
    ----------
    predicted : variance of one sample; infinite where the integral of f^2 / pdf diverges
    measured, error : variance of one sample and its standard error, over batches
    curve : root-mean-square error of the estimate with SHOWN samples
    seconds : median time of one such estimate
    """

    name: str
    predicted: float
    measured: float
    error: float
    curve: Floats64
    seconds: tuple[float, ...]

    @property
    def off(self) -> float:
        """How far the ratio of the two variances is from 1, in standard errors."""
        return (self.measured - self.predicted) / self.error


def measure_importance_sampling() -> list[Figure]:
    """Report and draw both integrals."""
    measured = [(each, measure(each, BATCHES, SAMPLES)) for each in (CUBE, HIGHLIGHT)]
    about = f"{BATCHES} estimates with each number of samples, and {ROUNDS} timed"
    report(
        "importance_sampling",
        about,
        [table(*each) for each in measured],
        [plot(*each) for each in measured],
    )
    figures = []
    for integrand, found in measured:
        path = OUT / f"importance_sampling_{integrand.name}.svg"
        print(f"written to {draw(integrand, found, path)}")
        figures += [
            summary(
                f"{integrand.title} by {way.name}: variance off by [standard errors]",
                [abs(way.off)],
                LIMIT,
            )
            for way in found
            if math.isfinite(way.predicted)
        ]
        gain = found[0].measured / min(way.measured for way in found)
        name = f"{integrand.title}: variance, uniform / best"
        figures.append(summary(name, [gain], 10, at_least=True))
    return figures


# ---------------------------------------------------------------- predictions


def predicted(integrand: Integrand) -> dict[str, float]:
    """Variance of one sample of each way; of the two combined, half of the samples are drawn from each."""
    f, m = integrand, integrand.lobe_exponent
    square = f.value**2
    return {
        "uniform": 4 * math.pi**2 * f.squared(0) - square,
        "cosine": 2 * math.pi**2 * f.squared(1) - square,
        "Phong lobe": 4 * math.pi**2 / (m + 1) * f.squared(m) - square,
        "cosine and lobe": combined(f),
    }


def combined(integrand: Integrand) -> float:
    """Variance of one sample of the power heuristic, by Gauss-Legendre quadrature over cos.

    Each density's part of the integral is weighted by w = p^2 / (p^2 + q^2), and n / 2 samples of each leave
    (V_p + V_q) / (n / 2), with V = the integral of (w f)^2 / p less the square of that of w f.
    """
    x, weight = np.polynomial.legendre.leggauss(400)
    cos, weight = 0.5 * (x + 1), math.pi * weight
    f, m = integrand(cos), integrand.lobe_exponent
    p, q = cos / math.pi, (m + 1) / (2 * math.pi) * cos**m
    variance = 0.0
    for mine, other in ((p, q), (q, p)):
        # mine / (mine^2 + other^2) times f: no division by a density that vanishes.
        share = mine * f / (mine**2 + other**2)
        variance += float(weight @ (share**2 * mine) - (weight @ (share * mine)) ** 2)
    return 2 * variance


# ---------------------------------------------------------------- measurements


def measure(integrand: Integrand, batches: int, samples: int) -> list[Measured]:
    """Each way's variance over batches, its error with few samples and many, and what an estimate takes."""
    rng = np.random.default_rng(1)
    ways = _ways(integrand)
    timed = {name: partial(_seeded, draw_values) for name, draw_values in ways.items()}
    seconds = median_seconds(timed, SHOWN, min(batches, ROUNDS))
    expected = predicted(integrand)
    found = []
    for name, draw_values in ways.items():
        estimates = np.array([draw_values(samples, rng) for _ in range(batches)])
        # The variance of a mean of n samples is an nth of that of one.
        variances = samples * estimates[:, 1]
        curve = []
        for n in SHOWN:
            means = np.array([draw_values(n, rng)[0] for _ in range(batches)])
            curve.append(math.sqrt(((means - integrand.value) ** 2).mean()))
        error = float(variances.std(ddof=1)) / math.sqrt(batches)
        found.append(
            Measured(
                name, expected[name], float(variances.mean()), error, np.array(curve), seconds[name]
            )
        )
    return found


def _seeded(draw_values: Draw, n: int, seed: int) -> tuple[float, float]:
    return draw_values(n, np.random.default_rng(seed))


def _ways(integrand: Integrand) -> dict[str, Draw]:
    """Functions of a number of samples: estimate and its variance."""
    m = integrand.lobe_exponent
    lobe_pdf = partial(phong_lobe_pdf, exponent=m)

    def along_lobe(u: Floats64) -> Floats64:
        axis = np.zeros((3, u.shape[1]))
        axis[2] = 1
        # A lobe reaches down to the horizon, and by rounding a hair below it.
        return np.maximum(sample_phong_lobe(axis, m, u), 0)

    def one(sample: Numbers, pdf: Numbers) -> Callable[..., tuple[float, float]]:
        def way(n: int, rng: np.random.Generator) -> tuple[float, float]:
            cos = sample(rng.random((2, n)))[2]
            mean, variance = estimate(integrand(cos), pdf(cos))
            return float(mean), float(variance)

        return way

    def both(n: int, rng: np.random.Generator) -> tuple[float, float]:
        mean = variance = 0.0
        pairs = ((cosine_hemisphere, cosine_hemisphere_pdf, lobe_pdf),)
        pairs += ((along_lobe, lobe_pdf, cosine_hemisphere_pdf),)
        for sample, mine, other in pairs:
            cos = sample(rng.random((2, n // 2)))[2]
            weight = power_heuristic(mine(cos), other(cos))
            part, spread = estimate(weight * integrand(cos), mine(cos))
            mean, variance = mean + float(part), variance + float(spread)
        return mean, variance

    return {
        "uniform": one(uniform_hemisphere, lambda cos: np.full_like(cos, 1 / (2 * math.pi))),
        "cosine": one(cosine_hemisphere, cosine_hemisphere_pdf),
        "Phong lobe": one(along_lobe, lobe_pdf),
        "cosine and lobe": both,
    }


def table(integrand: Integrand, found: list[Measured]) -> Table:
    """Variances of one sample, measured and predicted."""
    columns = ("directions", "predicted", "measured", "ratio", "standard error", "off by")
    rows = []
    for way in found:
        row = (way.name, "infinite", f"{way.measured:.4g}, by chance", NONE, NONE, NONE)
        if math.isfinite(way.predicted):
            row = (
                way.name,
                f"{way.predicted:.4f}",
                f"{way.measured:.4f}",
                f"{way.measured / way.predicted:.4f}",
                f"{way.error / way.predicted:.4f}",
                f"{way.off:+.2f} standard errors",
            )
        rows.append(row)
    title = f"The integral of {integrand.title} over the hemisphere, {integrand.value:.5f}: variance of one sample"
    return Table(title, columns, tuple(rows))


def plot(integrand: Integrand, found: list[Measured]) -> Plot:
    """The errors, measured and predicted, as the documentation's data files keep them.

    A predicted error stands at the seconds that as many samples took.
    """
    places = {way.name: {"samples": SHOWN, "seconds": way.seconds} for way in found}
    measured = [
        Series(way.name, style, places[way.name], tuple(way.curve.tolist()))
        for style, way in enumerate(found)
    ]
    expected = [
        Series(
            way.name,
            style,
            places[way.name],
            tuple(math.sqrt(way.predicted / n) for n in SHOWN),
            predicted=True,
        )
        for style, way in enumerate(found)
        if math.isfinite(way.predicted)
    ]
    title = f"the integral of {integrand.title} over the hemisphere"
    lines = tuple(expected + measured)
    axes = {"samples": "samples", "seconds": "seconds"}
    return Plot(integrand.name, title, axes, "RMSE", lines, slope=False)


# ---------------------------------------------------------------- the figure


def draw(integrand: Integrand, found: list[Measured], path: Path) -> Path:
    """Draw on the left the integrand and the densities over the angle, on the right the errors over samples."""
    from matplotlib import rc_context

    with rc_context(STYLE):
        about = "left: integrand and densities; right: error of the estimate, dashed as predicted"
        figure = sheet(f"Importance sampling of {integrand.title}", about, (13, 5.625))
        _densities(figure.add_axes((0.06, 0.15, 0.29, 0.62)), integrand)
        axes = figure.add_axes((0.43, 0.15, 0.345, 0.62))
        names = {way.name: f"{way.name}  {_variance(way)}" for way in found}
        draw_lines(axes, plot(integrand, found), "samples", names)
        axes.text(1.04, 1.03, "variance of one sample", transform=axes.transAxes, fontsize=12)
        return write(figure, path)


def _variance(way: Measured) -> str:
    return f"{way.predicted:.2f}" if math.isfinite(way.predicted) else "infinite"


def _densities(axes: object, integrand: Integrand) -> None:
    degrees = np.linspace(0, 90, 361)
    cos = np.cos(np.radians(degrees))
    m = integrand.lobe_exponent
    curves = (
        ("uniform", np.full_like(cos, 1 / (2 * math.pi))),
        ("cosine", cosine_hemisphere_pdf(cos)),
        (f"Phong lobe, exponent {m}", phong_lobe_pdf(cos, m)),
    )
    axes.plot(degrees, integrand(cos) / integrand.value, color="black", linewidth=3.5)
    for style, (_, density) in enumerate(curves):
        axes.plot(degrees, density, color=COLORS[style], linewidth=2)
    names = [f"{integrand.title}, over its integral", *(name for name, _ in curves)]
    axes.legend(names, fontsize=11, frameon=False, loc="upper right")
    axes.set(xlabel="angle to the axis [degrees]", xlim=(0, 90), xticks=(0, 30, 60, 90))
    axes.set_ylim(0)
    axes.text(0, 1.03, "density [1/sr]", transform=axes.transAxes, va="bottom")
