"""multiple_importance declared: densities in solid angle, weights for any number of strategies, and the estimators.

Estimators are tried with an integral that has a closed form: f = x^n over [0, 1), drawn with the densities
(m + 1) x^m, one m for each strategy.
"""

from collections.abc import Mapping
from math import nan, pi
from typing import Any

import numpy as np

from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Made, function, number
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, holds

LENGTHS = (1.0, 1e-6, 1e6)
"""Factors of all lengths."""

DENSE = (1.0, 1e-12, 1e12)
"""Factors of all densities."""

SMALL = (1e12,)
"""Size of a scene whose densities, over lengths, are small."""

# ---------------------------------------------------------------- area_density


def _lamp(draw: Draw) -> Mapping[str, Any]:
    """A flat lamp, whose area grows with the square of the scene's size; a third of the points lie behind it."""
    return {
        "area": draw.scale**2 * draw.number(0.01, 4),
        "distance": draw.lengths(0.25, 4, draw.n),
        "cos": np.where(draw.rng.random(draw.n) < 0.3, -1, 1) * draw.uniform(0.05, 1, draw.n),
    }


def _beside(draw: Draw) -> Mapping[str, Any]:
    """Points nearly in the lamp's plane."""
    return {**_lamp(draw), "cos": 10 ** draw.uniform(-8, -1, draw.n)}


def _by_area(a: Arguments, r: Array) -> tuple[Any, ...]:
    found = (a.distance**2) / a.area / np.abs(a.cos) * (a.cos > 0)
    return r, found, 1 / (2 * pi) + found


def _behind(draw: Draw) -> Mapping[str, Any]:
    cos = -draw.uniform(0.01, 1, draw.n)
    cos[:1] = 0
    return {**_lamp(draw), "cos": cos}


AREA_DENSITY = function(
    "multiple_importance.area_density",
    {"area": Made(wrong=(0.0, -1.0, nan))},
    (
        close(
            "behind",
            "Behind the lamp and beside it the density is 0",
            lambda _, r: (r, 0.0),
            "The lamp's back sends nothing, and seen from the side there is no direction that meets it.",
            what="a density of",
            case=_behind,
        ),
        close(
            "facing",
            "Straight in front of the lamp it is distance^2 / area",
            _by_area,
            "A lamp that is twice as far away fills a quarter of the directions.",
            what="in front of the lamp, a density of",
            case=lambda draw: {**_lamp(draw), "cos": np.ones(draw.n)},
            role="core",
        ),
        close(
            "beside",
            "Next to the lamp's plane densities are as large as they are",
            _by_area,
            "The cosine may be as small as it likes, as long as it is above 0.",
            what="at a grazing angle, a density of",
            case=_beside,
        ),
        close(
            "values",
            "The density is distance^2 / (area cos)",
            _by_area,
            "Seen at a slant, a lamp fills fewer directions, and each is denser.",
            what="a density of",
            scales=LENGTHS,
            whole=True,
        ),
    ),
    case=_lamp,
    scales=LENGTHS,
)

# ---------------------------------------------------------------- cone_density


def _ball(draw: Draw) -> Mapping[str, Any]:
    """A ball, and points within it and without."""
    radius = draw.scale * draw.number(0.1, 2)
    far = draw.uniform(1.1, 4, draw.n)
    near = 0.05 + 0.9 * draw.rng.random(draw.n)
    return {
        "radius": radius,
        "distance": radius * np.where(draw.rng.random(draw.n) < 0.2, near, far),
    }


def _by_cone(a: Arguments, r: Array) -> tuple[Any, ...]:
    squared = np.where(a.distance > a.radius, a.radius / np.maximum(a.distance, a.radius), 1) ** 2
    cos = np.sqrt(1 - squared)
    found = np.where(a.distance > a.radius, (1 + cos) / (2 * pi * squared), 0)
    return r, found, 1 / (2 * pi) + found


def _far(draw: Draw) -> Mapping[str, Any]:
    radius = draw.number(0.1, 2)
    return {"radius": radius, "distance": radius * 10 ** draw.rng.uniform(2, 6, draw.n)}


def _within(draw: Draw) -> Mapping[str, Any]:
    # A radius that single precision has too, so that some distances are just as large.
    radius = float(np.float32(draw.number(0.1, 2)))
    part = np.where(np.arange(draw.n) % 4 == 0, 1, 0.99 * draw.rng.random(draw.n))
    return {"radius": radius, "distance": radius * part}


CONE_DENSITY = function(
    "multiple_importance.cone_density",
    {"radius": Made(wrong=(0.0, -1.0, nan))},
    (
        close(
            "inside",
            "Within the ball and on it the density is 0, at its centre too",
            lambda _, r: (r, 0.0),
            "The lamp shines outwards: nothing arrives within it, and distance <= radius counts as within.",
            what="a density of",
            case=_within,
        ),
        close(
            "far",
            "Of lamps that are far away no digits are lost",
            _by_cone,
            "1 - cos has no digits left where cos is next to 1; sin^2 / (1 + cos) is the same.",
            what="for a small lamp far away, a density of",
            within=64,
            case=_far,
        ),
        close(
            "values",
            "The density is one over the cone's solid angle",
            _by_cone,
            "2 pi (1 - cos) steradian, and the sine is radius over distance.",
            what="a density of",
            within=256,
            scales=LENGTHS,
            whole=True,
        ),
    ),
    case=_ball,
    scales=LENGTHS,
)

# ---------------------------------------------------------------- heuristic_weights, delta_weights


def _many(draw: Draw) -> int:
    return 2 if draw.simple else int(draw.rng.integers(1, 6))


def _counts(draw: Draw, several: int) -> Array:
    """How many samples each strategy takes: a few, or hundreds."""
    most = 8 if draw.simple else 400
    return np.exp(draw.rng.uniform(0, np.log(most), several)).astype(int)


def _strategies(draw: Draw) -> Mapping[str, Any]:
    """One to five strategies; some densities are 0."""
    several = _many(draw)
    densities = draw.lengths(0.1, 9, several, draw.n)
    densities[draw.rng.random(densities.shape) < 0.15] = 0
    return {"counts": _counts(draw, several), "densities": densities}


def _two(draw: Draw) -> Mapping[str, Any]:
    return {"counts": _counts(draw, 2), "densities": draw.lengths(0.1, 9, 2, draw.n)}


def _nobody(draw: Draw) -> Mapping[str, Any]:
    """Samples that no strategy draws, and a strategy that takes none."""
    densities = draw.lengths(0.1, 9, 3, draw.n)
    densities[:, ::2] = 0
    densities[1:, 1::4] = 0
    return {"counts": np.array([0, 2, 5]), "densities": densities}


def _unlike(draw: Draw) -> Mapping[str, Any]:
    """Densities whose ratio is anything from 1e-16 to 1e16."""
    densities = draw.scale * 10 ** draw.rng.uniform(-8, 8, (3, draw.n))
    return {"counts": _counts(draw, 3), "densities": densities}


def _steep(draw: Draw) -> Mapping[str, Any]:
    """An exponent so large that powers of most numbers are none."""
    return {**_two(draw), "counts": np.array([300, 500]), "exponent": draw.number(150, 400)}


def _shares(counts: Array, densities: Array, exponent: float) -> Array:
    """In logarithms, as no solution has it."""
    with np.errstate(divide="ignore"):
        logs = exponent * np.log(counts[:, None] * densities)
    some = np.isfinite(logs).any(axis=0)
    best = np.where(some, logs.max(axis=0, initial=-np.inf), 0)
    with np.errstate(invalid="ignore"):
        powers = np.exp(logs - best)
    return np.asarray(np.divide(powers, np.where(some, powers.sum(axis=0), 1)))


def _weights(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, _shares(a.counts, a.densities, a.exponent), 1.0


COUNTS = Made(wrong=(np.array([[1]]), np.array([2, -1, 3, 1, 2, 1])), batch=False)

HEURISTIC_WEIGHTS = function(
    "multiple_importance.heuristic_weights",
    {"counts": COUNTS, "exponent": number(1, 4, (0.5, -1.0, nan))},
    (
        holds(
            "sum",
            "Weights of one sample add up to 1",
            lambda _, r: np.abs(r.sum(axis=0) - 1) < 1e-5,
            "weights that add up to 1",
            "The mean is right for any weights that do.",
            shows=lambda _, r: r.sum(axis=0),
            case=_two,
        ),
        close(
            "nobody",
            "What no strategy draws has weight 0, and a strategy without samples has none",
            _weights,
            "0 / 0 is no number; and who takes no samples has no share.",
            what="a weight of",
            case=_nobody,
        ),
        close(
            "extremes",
            "Very large, very small and very unlike densities weigh as their ratio says",
            _weights,
            "A power of a large density overflows, and powers of small ones all vanish: divide by the largest first.",
            what="a weight of",
            case=_unlike,
            scales=DENSE,
        ),
        close(
            "steep",
            "Large exponents leave numbers",
            _weights,
            "Divide by the largest product first: its power is 1 then, and no other is larger.",
            what="a weight of",
            floor=1e-3,
            case=_steep,
        ),
        close(
            "balance",
            "With exponent 1 weights are shares of counts times densities",
            _weights,
            "How many samples of each strategy land here, and how many of all?",
            what="a weight of",
            case=lambda draw: {**_strategies(draw), "exponent": 1.0},
            role="core",
        ),
        close(
            "values",
            "Weights are shares of powers of counts times densities",
            _weights,
            "Counts belong within the power, and the sum runs over all strategies.",
            what="a weight of",
            whole=True,
        ),
    ),
    case=_strategies,
    scales=DENSE,
)


def _deltas(draw: Draw) -> Mapping[str, Any]:
    """Strategies some of which are deltas at some samples; for a third of the samples, none is.

    Half of the deltas don't draw the sample.
    """
    a = dict(_strategies(draw))
    a["delta"] = draw.rng.random(a["densities"].shape) < 0.4
    a["delta"] &= draw.rng.random(draw.n) < 0.7
    a["densities"][a["delta"] & (draw.rng.random(a["delta"].shape) < 0.5)] = 0
    return a


def _densities_alone(draw: Draw) -> Mapping[str, Any]:
    a = dict(_strategies(draw))
    return {**a, "delta": np.zeros(a["densities"].shape, bool)}


def _one_delta(draw: Draw) -> Mapping[str, Any]:
    """A mirror among densities that are far larger than its probability."""
    densities = draw.lengths(50, 90, 2, draw.n)
    densities[0] = draw.uniform(0.1, 1, draw.n)
    delta = np.zeros((2, draw.n), bool)
    delta[0] = True
    return {"counts": _counts(draw, 2), "densities": densities, "delta": delta}


def _no_delta(draw: Draw) -> Mapping[str, Any]:
    """Two deltas that don't draw the sample: one has the probability 0, the other takes no samples."""
    counts, densities = _counts(draw, 4), draw.lengths(0.1, 9, 4, draw.n)
    counts[1] = densities[2] = 0
    delta = np.zeros((4, draw.n), bool)
    delta[1:3] = True
    return {"counts": counts, "densities": densities, "delta": delta}


def _with_deltas(a: Arguments, r: Array) -> tuple[Any, ...]:
    met = np.asarray(a.delta, bool) & (a.counts[:, None] * a.densities > 0)
    kept = np.where(met.any(axis=0), met, True)
    return r, _shares(a.counts, np.where(kept, a.densities, 0.0), 1.0), 1.0


DELTA_WEIGHTS = function(
    "multiple_importance.delta_weights",
    {"counts": COUNTS},
    (
        close(
            "mirror",
            "What a delta draws is its own, however large other densities are",
            _with_deltas,
            "A probability is beyond any density: the two can't be compared.",
            what="a weight of",
            case=_one_delta,
        ),
        close(
            "elsewhere",
            "A delta that doesn't draw the sample takes nothing from the others",
            _with_deltas,
            "A lobe's direction isn't the mirror's: there its probability is 0. And who takes no samples draws none.",
            what="a weight of",
            case=_no_delta,
        ),
        close(
            "sizes",
            "Very large and very small densities have shares as others do",
            _with_deltas,
            "Who draws a sample has a density over 0, however small.",
            what="a weight of",
            scales=DENSE[1:],
        ),
        close(
            "none",
            "Without deltas weights are the balance heuristic's",
            _with_deltas,
            what="a weight of",
            case=_densities_alone,
            role="core",
        ),
        close(
            "values",
            "Deltas share the weight among them, and densities without any",
            _with_deltas,
            "Leave densities out where any delta draws the sample, then share as before.",
            what="a weight of",
            whole=True,
        ),
    ),
    contract="counts: S, densities: S N, delta: S N -> the weights: S N",
    case=_deltas,
    scales=DENSE,
)


# ---------------------------------------------------------------- multi_sample, one_sample

POWERS = np.array([1.0, 2.0, 3.0])
"""Of x, the integrand in each channel."""


def _drawn(draw: Draw, each: Array) -> tuple[Array, Array, Array]:
    """Strategies (N,), values (3, N) and densities (S, N) of stratified samples, so many of each of S strategies."""
    powers = np.arange(len(each))
    strategy = np.repeat(powers, each)
    place = np.concatenate([(np.arange(k) + 0.5) / k for k in each if k])
    x = place ** (1 / (strategy + 1))
    order = draw.rng.permutation(len(x))
    densities = (powers[:, None] + 1) * x ** powers[:, None]
    return strategy[order], (x ** POWERS[:, None])[:, order], densities[:, order]


def _samples(draw: Draw) -> Mapping[str, Any]:
    """Values of both signs, and densities and weights that have little to do with them; some densities are 0."""
    several = 2 if draw.simple else int(draw.rng.integers(1, 60))
    densities = draw.uniform(0.2, 3, draw.n) / draw.scale
    densities[draw.rng.random(draw.n) < 0.1] = 0
    return {
        "counts": _counts(draw, several),
        "strategy": draw.rng.integers(0, several, draw.n),
        "f": draw.lengths(-2, 4, 3, draw.n),
        "densities": densities,
        "weights": draw.uniform(0, 1, draw.n),
    }


def _summed(a: Arguments, r: Array) -> tuple[Any, ...]:
    drawn = a.counts[a.strategy] * a.densities
    parts = np.where(drawn > 0, a.f * a.weights / np.where(drawn > 0, drawn, 1), 0)
    return r, parts.sum(axis=1), np.abs(parts).sum() + 1e-30


def _integrated(draw: Draw) -> Mapping[str, Any]:
    """Samples of three strategies, balance weights, and an integral that is known."""
    counts = np.array([400, 100, 900])
    strategy, found, densities = _drawn(draw, counts)
    weights = _shares(counts, densities, 1.0)
    own = strategy, np.arange(len(strategy))
    return {
        "counts": counts,
        "strategy": strategy,
        "f": found,
        "densities": densities[own],
        "weights": weights[own],
    }


def _never(draw: Draw) -> Mapping[str, Any]:
    """Every other sample has density 0, and a value."""
    a = dict(_samples(draw))
    a["densities"][::2] = 0
    return a


MULTI_SAMPLE = function(
    "multiple_importance.multi_sample",
    {"counts": Made(wrong=(np.array([[1, 2]]),), batch=False)},
    (
        close(
            "zero_density",
            "Samples of density 0 count 0",
            _summed,
            "Nothing is divided by 0.",
            what="a sum of",
            case=_never,
        ),
        close(
            "integral",
            "An integral is right, by three strategies of unlike counts",
            lambda _, r: (r, 1 / (POWERS + 1)),
            "Each strategy is averaged over its own samples, and the averages are added.",
            what="an integral of",
            floor=3e-3,
            case=_integrated,
            role="core",
        ),
        close(
            "small",
            "Small densities divide as large ones do",
            _summed,
            "A density of 0 is the only one that counts 0.",
            what="of densities below 1e-10, a sum of",
            within=64,
            scales=SMALL,
        ),
        close(
            "values",
            "The sum of w f / (n p)",
            _summed,
            "n is the count of the strategy that has drawn the sample.",
            what="a sum of",
            within=64,
            scales=LENGTHS,
            whole=True,
        ),
    ),
    contract="counts: S, strategy: N, f: 3 N, densities: N, weights: N -> the estimate: 3",
    case=_samples,
    columns=False,
    scales=LENGTHS,
)


def _chosen(draw: Draw) -> Mapping[str, Any]:
    """Values of both signs, and strategies chosen by unlike odds; some draw a sample with probability 0, never all."""
    several = _many(draw)
    odds = draw.uniform(0.5, 3, several)
    densities = draw.uniform(0.2, 3, several, draw.n) / draw.scale
    densities[1:][draw.rng.random(densities[1:].shape) < 0.15] = 0
    return {"odds": odds / odds.sum(), "f": draw.lengths(-2, 4, 3, draw.n), "densities": densities}


def _one_each(a: Arguments, r: Array) -> tuple[Any, ...]:
    drawn = (a.odds[:, None] * a.densities).sum(axis=0)
    found = np.where(drawn > 0, a.f / np.where(drawn > 0, drawn, 1), 0)
    return r, found, np.abs(found) + 1e-30


def _undrawn(draw: Draw) -> Mapping[str, Any]:
    """Every other sample is one that no strategy draws, though it has a value."""
    a = dict(_chosen(draw))
    a["densities"][:, ::2] = 0
    return a


def _by_odds(draw: Draw) -> Mapping[str, Any]:
    each = np.array([600, 300, 1100])
    _, found, densities = _drawn(draw, each)
    return {"odds": each / each.sum(), "f": found, "densities": densities}


ONE_SAMPLE = function(
    "multiple_importance.one_sample",
    {"odds": Made(wrong=(np.array([[1.0]]), np.array([-1.0, 2, 1, 1, 1, 1])), batch=False)},
    (
        close(
            "undrawn",
            "What no strategy draws counts 0",
            _one_each,
            "Nothing is divided by 0.",
            what="an estimate of",
            case=_undrawn,
        ),
        close(
            "integral",
            "The mean of many estimates is the integral",
            lambda _, r: (r.mean(axis=1), 1 / (POWERS + 1)),
            "Together the strategies have one density: the mean of theirs, by their odds.",
            what="an integral of",
            floor=3e-3,
            case=_by_odds,
            role="core",
        ),
        close(
            "small",
            "Small densities divide as large ones do",
            _one_each,
            "A sum of 0 is the only one that nobody draws.",
            what="of densities below 1e-10, an estimate of",
            scales=SMALL,
        ),
        close(
            "values",
            "Each estimate is f / sum_k (c_k p_k)",
            _one_each,
            "With balance weights the density of the strategy that was chosen cancels.",
            what="an estimate of",
            floor=1e-2,  # a small number added to what is divided by is a mistake where it is 0
            whole=True,
        ),
    ),
    contract="odds: S, f: 3 N, densities: S N -> the estimates: 3 N",
    case=_chosen,
    scales=LENGTHS,
)

FUNCTIONS = (AREA_DENSITY, CONE_DENSITY, HEURISTIC_WEIGHTS, DELTA_WEIGHTS, MULTI_SAMPLE, ONE_SAMPLE)
