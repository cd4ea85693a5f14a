"""importance_sampling declared: directions and their densities, the estimate, and the power heuristic.

The integrand is cos^n over the hemisphere wherever one is needed. Its integral is 2 pi / (n + 1), and the variance that
each way of sampling leaves has a closed form.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from math import comb, nan, pi, sqrt
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import Arguments, Function, Law, Made, function, values
from course.school.grading.checks.distributions import FALSE_FAIL, MANY, SIGMAS, uniform
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.laws import EPSILON, close, unit_length, within

SEVERAL = (1.0, 1.0, 1.0, 1.0)
"""Scales of a law without lengths: each makes other numbers."""
MAGNITUDES = (1.0, 1e-3, 1e3)
ENDS = (2e-5, 1.0, 5e4)
"""Scales of densities from 0.05 to 20: all between 1e-6 and 1e6."""

WRONG = tuple(np.array([1, wrong, 2, 3], np.float32) for wrong in (-1, nan))
"""Densities that none has."""

DENSITIES = Made(
    lambda d: d.lengths(0.05, 20, d.n), WRONG, lambda dtype: np.array([0, 1e-6, 1, 1e6], dtype)
)

NONE: Mapping[str, Made] = {}


def _integral(n: float) -> float:
    """Of cos^n over the hemisphere [sr]."""
    return 2 * pi / (n + 1)


def _central(n: int, lobe: float, order: int) -> float:
    """A central moment of f / pdf, f = cos^n sampled by a Phong lobe of another exponent.

    Exponent 0 is the uniform hemisphere, 1 the cosine.
    """
    scale, mean = _integral(lobe), _integral(n)
    return sum(
        comb(order, k)
        * (-mean) ** (order - k)
        * scale**k
        * ((lobe + 1) / (k * (n - lobe) + lobe + 1))
        for k in range(order + 1)
    )


# ---------------------------------------------------------------- uniform_hemisphere, cosine_hemisphere


def _turn(directions: Array) -> Array:
    """About +z, 0 to 1."""
    return np.asarray(np.arctan2(directions[1], directions[0]) / (2 * pi) % 1)


def _hemisphere(name: str, lobe: int, density: str) -> Function:
    """Directions distributed as a Phong lobe of that exponent about +z."""
    height = ("z", "z^2")[lobe]
    return function(
        f"importance_sampling.{name}",
        {},
        (
            within(
                "hemisphere",
                "Directions are above the horizon",
                lambda _, r: r[2],
                0,
                1,
                "It is half a sphere, the half about +z.",
                what="a height z",
                n=5000,
            ),
            unit_length(),
            uniform(
                "density",
                f"Directions have density {density}",
                lambda _, r: np.stack((np.clip(r[2], 0, 1) ** (lobe + 1), _turn(r))),
                (16, 16),
                f"With the right density {height} is uniform from 0 to 1, and so is the turn.",
                what=f"{height} and turn of the directions",
                picture=lambda _, r: r[:2],
            ),
            smooth(10.0),
            evenly(lambda _, r: r[2] + 0.3 * r[0] + 0.2 * r[1], (lobe + 1) / (lobe + 2)),
        ),
        free=True,
        features=lambda _, r: np.stack((*r, _turn(r))),
        scales=(),
    )


# ---------------------------------------------------------------- densities


def _below(draw: Draw) -> Mapping[str, Any]:
    """Cosines below the horizon; powers of an even exponent hide it."""
    cos = -(10 ** draw.uniform(-6, 0, draw.n))
    return {"cos": cos, "exponent": 2.0 * draw.rng.integers(1, 5)}


def _density(a: Arguments, r: Array) -> tuple[Any, ...]:
    """What came and what should have; the scale grows with the exponent, as rounding does in repeated products."""
    n = a.get("exponent", 1.0)
    expected = (n + 1) / (2 * pi) * np.clip(a.cos, 0, None) ** n
    return r, np.where(a.cos < 0, 0, expected), (n + 1) * (1 + n / 8) / (2 * pi)


_dense = partial(close, compare=_density, what="a density of")


def _pdf(name: str, more: Mapping[str, Made] = NONE, laws: tuple[Law, ...] = ()) -> Function:
    """A density about an axis."""
    ends = (-1.0, -1e-7, 0.0, 1e-30, 1e-7, 0.5, 1.0)
    return function(
        f"importance_sampling.{name}",
        {"cos": replace(values(0, 1), corners=lambda dtype: np.array(ends, dtype)), **more},
        (
            close(
                "below",
                "Below the horizon the density is 0",
                lambda _, r: (r, 0.0),
                "No direction is ever sampled there.",
                what="below the horizon, a density of",
                case=_below,
                scales=SEVERAL,
            ),
            *laws,
            _dense(
                "values",
                "The density is its formula",
                hint="Its integral over the hemisphere is 1.",
                case=lambda d: {"cos": d.uniform(0.01, 1, d.n)},
                scales=SEVERAL,
                role="core",
            ),
        ),
        scales=(),
    )


def _flat(draw: Draw) -> Mapping[str, Any]:
    """Exponent 0, and cosines of both signs and 0."""
    cos = draw.uniform(-1, 1, draw.n)
    cos[:1] = 0
    return {"cos": cos, "exponent": 0.0}


def _sharp(draw: Draw) -> Mapping[str, Any]:
    """Large exponents, and cosines where their lobes are."""
    exponent = draw.number(5, 1e6)
    return {"cos": 1 - draw.uniform(0, 4, draw.n) / exponent, "exponent": exponent}


PHONG = _pdf(
    "phong_lobe_pdf",
    {"exponent": declare.number(0.5, 5, (-1.0, -1e-6, nan))},
    (
        _dense(
            "flat",
            "A lobe of exponent 0 is the uniform hemisphere, its horizon included",
            hint="Exponent 0 is the uniform hemisphere.",
            case=_flat,
        ),
        _dense(
            "sharp",
            "Lobes of large exponents have their density, well over 1",
            hint="A density is no probability: it may be as large as it has to.",
            case=_sharp,
            scales=SEVERAL,
        ),
    ),
)


# ---------------------------------------------------------------- estimate


def _samples(draw: Draw) -> Mapping[str, Any]:
    """Values of both signs in one channel or three, and densities that have little to do with them."""
    f = draw.lengths(-2, 4, int(draw.rng.choice((1, 3))), draw.n)
    return {"f": f, "pdf": draw.uniform(0.2, 3, draw.n) / draw.scale}


def _some_of_none(draw: Draw) -> Mapping[str, Any]:
    """Samples, among them some of density 0."""
    a = dict(_samples(draw))
    none = draw.rng.random(draw.n) < 0.3
    none[: (draw.n + 1) // 2] |= draw.n < 4
    a["f"][..., none], a["pdf"][none] = 0, 0
    return a


def _large(draw: Draw) -> Mapping[str, Any]:
    """Values whose variance is small beside the square of their mean."""
    return {"f": 3000 + draw.uniform(0, 1, 2, draw.n), "pdf": np.ones(draw.n)}


def _small(draw: Draw) -> Mapping[str, Any]:
    """Densities so small that a floor under them would be felt."""
    a = dict(_samples(draw))
    return a | {"pdf": 1e-12 * a["pdf"]}


def _quotients(a: Arguments) -> Array:
    """What each sample says: f / pdf, and 0 where the density is."""
    return np.asarray(np.where(a.pdf > 0, a.f / np.where(a.pdf > 0, a.pdf, 1), 0))


def _mean(a: Arguments, r: Any) -> tuple[Any, ...]:
    """A sum of N numbers, one after the other, rounds N times."""
    x = _quotients(a)
    n = x.shape[-1]
    size = np.abs(x).sum(axis=-1) * (1 / max(n, 1) + 1 / 32)
    return r[0], x.sum(axis=-1) / max(n, 1), size


def _variance(a: Arguments, r: Any) -> tuple[Any, ...]:
    """That of the mean; rounding is as large as that of the quotients' squares."""
    x = _quotients(a)
    n = x.shape[-1]
    if n < 2:
        return r[1], 0.0
    return r[1], x.var(axis=-1, ddof=1) / n, (x * x).max(axis=-1) * (1 / n + 1 / 32)


def _stacked(*rows: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(np.stack(np.broadcast_arrays(*each)) for each in zip(*rows, strict=False))


def _both(a: Arguments, r: Any) -> tuple[Any, ...]:
    return _stacked(_mean(a, r), _variance(a, r))


def _roughly(a: Arguments, r: Any) -> tuple[Any, ...]:
    """Both, each on its own scale: so N for N - 1, another law's, doesn't show among many samples."""
    rows = _mean(a, r), _variance(a, r)
    return _stacked(*((found, expected, np.abs(expected)) for found, expected, _ in rows))


def _for_counts(counts: tuple[int, ...], *how: Any, **more: Any) -> Law:
    """Values that are what they should be, for so many samples each."""
    tried = [close(*how, n=count, **more) for count in counts]

    def run(function: Function, trial: Trial) -> None:
        for each in tried:
            each.run(function, trial)

    return replace(tried[0], run=run)


def _one_channel(_: Function, trial: Trial) -> None:
    of_two_numbers = function(
        "importance_sampling.estimate",
        {"f": values(-4, 4), "pdf": values(0.2, 3)},
        (),
        contract="f: N, pdf: N -> the mean: floating, the variance: floating",
        columns=False,
    )
    hint = "Channels are averaged over their samples, each by itself; one alone gives two numbers."
    one = _for_counts((0, 1, 2, 50), "", "", _both, hint, what="of one channel,")
    one.run(of_two_numbers, trial)


def _predicted(function: Function, trial: Trial) -> None:
    """Uniform, cosine and Phong lobe: the variances that theory tells for cos^n."""
    n = int(trial.rng.integers(3, 6))
    for lobe, name in ((0, "uniform"), (1, "cosine-weighted"), (n - 1, f"Phong ({n - 1})")):
        cos = trial.rng.random(MANY) ** (1 / (lobe + 1))
        a = Arguments(f=cos[None] ** n, pdf=cos**lobe / _integral(lobe))
        mean, variance = (float(x[0]) for x in function.call(trial, a))
        exact = _central(n, lobe, 2)
        of_variance = sqrt((_central(n, lobe, 4) - exact**2) / MANY) / MANY
        for what, found, expected, spread in (
            ("mean", mean, _integral(n), sqrt(exact / MANY)),
            ("variance", variance, exact / MANY, of_variance),
        ):
            if not abs(found - expected) <= SIGMAS * spread:
                raise Failure(
                    f"for cos^{n} by {name} sampling, {what} {expected:.5g} within {SIGMAS * spread:.2g}",
                    f"{found:.5g}",
                    f"N = {MANY}",
                    "The same integral each time; the closer the density, the smaller the variance.",
                )


ESTIMATE = function(
    "importance_sampling.estimate",
    {"pdf": Made(wrong=(*WRONG, np.array([2, 0, 1, 3], np.float32)))},
    (
        close(
            "zero_density",
            "Samples of density 0 count 0",
            _both,
            "A sample of density 0 counts 0, and it does count.",
            what="with samples of density 0, a mean or variance of",
            n=200,
            case=_some_of_none,
        ),
        close(
            "small_densities",
            "Small densities divide as large ones do",
            _both,
            "Only a density of 0 can't be divided by.",
            what="of densities below 1e-10, a mean or variance of",
            n=200,
            case=_small,
        ),
        close(
            "small_variance",
            "A small variance about a large mean is not lost in rounding",
            lambda a, r: _variance(a, r)[:2],
            "The difference of two large means of squares has no digits left.",
            what="a variance of",
            within=4e-3 / EPSILON,
            case=_large,
        ),
        _for_counts(
            (0, 1, 2, 3, 5),
            "few",
            "Mean and variance of few samples are right, of none and of one, too",
            _both,
            "The mean was estimated from the same samples, and lies closer to them than the true one.",
            what="of few samples, a mean or variance of",
            scales=MAGNITUDES,
        ),
        Law("one_channel", "One channel gives two numbers", _one_channel),
        Law(
            "predicted",
            "Uniform, cosine and Phong sampling leave the variances that theory tells",
            _predicted,
            kind="distribution",
            false_fail=6 * FALSE_FAIL,
        ),
        close(
            "mean",
            "The estimate is the mean of f / pdf",
            _mean,
            "Each sample counts as much as it is rare: its value, with its sign, over its density.",
            what="a mean of",
            scales=MAGNITUDES,
        ),
        close(
            "variance",
            "The variance is that of the mean",
            _roughly,
            "The variance is that of this mean, not that of one sample.",
            what="a mean or variance of",
            within=4e-3 / EPSILON,
            scales=MAGNITUDES,
            role="core",
        ),
    ),
    contract="f: C N, pdf: N -> the mean: C, the variance: C",
    case=_samples,
    columns=False,
    scales=MAGNITUDES,
)


# ---------------------------------------------------------------- power_heuristic


def _weight(a: Arguments, r: Array) -> tuple[Any, ...]:
    total = a.a**2 + a.b**2
    return r, np.where(a.a > 0, a.a**2 / np.where(total > 0, total, 1), 0), 1.0


_weighed = partial(close, compare=_weight, what="a weight of")


def _zeros(draw: Draw) -> Mapping[str, Any]:
    """One density is 0, the other, both, or none."""
    a, b = draw.lengths(0.05, 20, 2, draw.n)
    a[1::4], b[2::4], a[3::4], b[3::4] = 0, 0, 0, 0
    return {"a": a, "b": b}


def _unlike(draw: Draw) -> Mapping[str, Any]:
    """Small or large densities, whose ratio is anything from 1e-6 to 1e6."""
    a, b = draw.lengths(0.05, 20, 2, draw.n)
    return {"a": a, "b": np.clip(b * np.exp(draw.rng.uniform(-14, 14, draw.n)), 1e-6, 1e6)}


POWER_HEURISTIC = function(
    "importance_sampling.power_heuristic",
    dict.fromkeys(("a", "b"), DENSITIES),
    (
        _weighed(
            "limits",
            "Where one density or both are 0",
            hint="What only one density could have drawn is its own; what none could have counts 0.",
            case=_zeros,
        ),
        _weighed(
            "extremes",
            "Very large, very small and very unlike densities weigh as their ratio says",
            hint="The weight depends on the ratio alone, whatever the densities' size.",
            case=_unlike,
            scales=ENDS,
        ),
        _weighed(
            "values",
            "Weights are a^2 / (a^2 + b^2)",
            hint="The power is 2, and the weight is that of the sample drawn with a.",
            role="core",
        ),
    ),
    scales=ENDS,
)

FUNCTIONS = (
    _hemisphere("uniform_hemisphere", 0, "1 / (2 pi)"),
    _hemisphere("cosine_hemisphere", 1, "cos / pi"),
    _pdf("cosine_hemisphere_pdf"),
    PHONG,
    ESTIMATE,
    POWER_HEURISTIC,
)
