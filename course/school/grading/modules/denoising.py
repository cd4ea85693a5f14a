"""denoising declared: Welch's statistic, its degrees of freedom and critical values, weights, means and their bias.

Values that hang on a comparison keep away from where it jumps, but for the law that asks for the very end.
"""

from collections.abc import Mapping
from math import inf, nan
from typing import Any

import numpy as np
from scipy.special import ndtri, stdtrit

from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Made, function, number
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import EPSILON, close, holds

SCALES = (1.0, 1e-6, 1e6)
"""Factors of all radiances."""

FAINT = (1e-15,)
"""Radiance of pixels whose standard errors are small, and not 0."""

EXACT = 0.005
"""Share by which a critical value may be off."""

CLEAR = 0.02
"""Share of a critical value within which a statistic is not tried."""


def _pixels(draw: Draw, name: str, least: int = 2) -> dict[str, Array]:
    """Means, sample variances and counts of pixels."""
    return {
        f"mean_{name}": draw.lengths(0.5, 4, 3, draw.n),
        f"variance_{name}": draw.scale**2 * draw.uniform(0.5, 4, 3, draw.n),
        f"count_{name}": draw.rng.integers(least, 5 if draw.simple else 65, draw.n).astype(float),
    }


def _pair(draw: Draw) -> Mapping[str, Any]:
    return {**_pixels(draw, "a"), **_pixels(draw, "b")}


def _few_and_many(draw: Draw) -> Mapping[str, Any]:
    """A pixel of few samples beside one of many."""
    return {**_pair(draw), "count_a": np.full(draw.n, 2.0), "count_b": np.full(draw.n, 256.0)}


def _sure(draw: Draw) -> Mapping[str, Any]:
    """Pixels whose samples are all the same; some of them have equal means."""
    black = np.zeros((3, draw.n))
    means = {f"mean_{x}": draw.scale * draw.rng.choice((0.25, 0.5, 1.0), (3, draw.n)) for x in "ab"}
    return {**_pair(draw), **means, "variance_a": black, "variance_b": black}


def _one_sure(draw: Draw) -> Mapping[str, Any]:
    """Only the second pixel's samples differ."""
    return {**_pair(draw), "variance_a": np.zeros((3, draw.n))}


def _without_means(made: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in made.items() if not name.startswith("mean")}


# ---------------------------------------------------------------- welch_t


def _statistic(a: Arguments, r: Array) -> tuple[Any, ...]:
    difference = a.mean_a - a.mean_b
    error = np.sqrt(a.variance_a / a.count_a + a.variance_b / a.count_b)
    with np.errstate(divide="ignore", invalid="ignore"):
        expected = np.where(difference == 0, 0, difference / error)
        # What rounding does to the difference counts in standard errors.
        size = (np.abs(a.mean_a) + np.abs(a.mean_b)) / error
    return r, expected, np.where(error > 0, size, 0)


WELCH_T = function(
    "denoising.welch_t",
    {},
    (
        close(
            "certain",
            "Where no samples differ, equal means give 0 and others an infinity",
            _statistic,
            "A division by 0 has to be looked at: 0 / 0 is no number. Which sign has the difference?",
            what="of two variances of 0, a statistic of",
            case=_sure,
            scales=(1.0, *FAINT),
        ),
        close(
            "one_certain",
            "The variance of one pixel is enough",
            _statistic,
            "Only if both variances are 0 is nothing known of the error.",
            what="of one variance of 0, a statistic of",
            case=_one_sure,
        ),
        close(
            "counts",
            "Few samples count as few",
            _statistic,
            "Each variance is divided by its own number of samples.",
            what="of 2 and 256 samples, a statistic of",
            case=_few_and_many,
            role="core",
        ),
        close(
            "faint",
            "Dark pixels differ by as many standard errors as bright ones",
            _statistic,
            "Only an error of 0 can't be divided by.",
            what="of dark pixels, a statistic of",
            scales=FAINT,
        ),
        close(
            "values",
            "The difference is measured in standard errors",
            _statistic,
            "Variances of independent means add up; the standard error is the root of their sum.",
            what="a statistic of",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_pair,
    scales=SCALES,
)

# ---------------------------------------------------------------- degrees_of_freedom


def _degrees(a: Arguments, r: Array) -> tuple[Any, ...]:
    v, w = a.variance_a / a.count_a, a.variance_b / a.count_b
    both = np.where(v + w > 0, v + w, 1)
    squares = (v / both) ** 2 / (a.count_a - 1) + (w / both) ** 2 / (a.count_b - 1)
    known = squares > 0
    expected = np.where(known, 1 / np.where(known, squares, 1), a.count_a + a.count_b - 2)
    return r, expected, expected


DEGREES_OF_FREEDOM = function(
    "denoising.degrees_of_freedom",
    {},
    (
        close(
            "alike",
            "Of two pixels of equal variance and n samples they are 2 (n - 1)",
            lambda a, r: (r, 2.0 * (a.count_a - 1)),
            "As in Student's test for equal variances.",
            what="degrees of freedom:",
            case=lambda d: {
                **(made := _without_means(_pair(d))),
                "variance_b": made["variance_a"],
                "count_b": made["count_a"],
            },
        ),
        close(
            "one_certain",
            "If only one pixel's samples differ, they are one less than its samples",
            lambda a, r: (r, np.broadcast_to(a.count_b - 1, r.shape)),
            "The other pixel adds nothing to numerator and denominator.",
            what="degrees of freedom:",
            case=lambda d: _without_means(_one_sure(d)),
        ),
        close(
            "certain",
            "Where no samples differ they are n_a + n_b - 2",
            _degrees,
            "0 / 0 is no number, and has to be looked at.",
            what="of two variances of 0, degrees of freedom:",
            case=lambda d: _without_means(_sure(d)),
        ),
        close(
            "values",
            "They are those of Welch and Satterthwaite",
            _degrees,
            "The formula is of v = s^2 / n: each variance is divided by its count before anything is squared.",
            what="degrees of freedom:",
            within=64,
            scales=SCALES,
            whole=True,
        ),
    ),
    case=lambda d: _without_means(_pair(d)),
    scales=SCALES,
)

# ---------------------------------------------------------------- critical_value


def _exact(a: Arguments, r: Array) -> tuple[Any, ...]:
    expected = stdtrit(a.degrees, 1 - a.level / 2)
    return r, expected, expected


def _falling(a: Arguments, r: Array) -> Array:
    """Whether a pixel with more degrees of freedom has no larger value, but for what may be off."""
    order = np.argsort(a.degrees)
    found = np.ones(order.size, bool)
    found[order[1:]] = r[order[1:]] <= r[order[:-1]] * (1 + 2 * EXACT)
    return found


def _any_degrees(draw: Draw) -> Array:
    if draw.simple:
        return draw.rng.integers(1, 9, draw.n).astype(float)
    return np.asarray(1 / draw.rng.uniform(0.002, 1, draw.n))


def _beyond_tables(draw: Draw) -> Mapping[str, Any]:
    """Tables of books end at 30, 100 or 200 degrees, and then have the normal distribution's."""
    return {"degrees": 10.0 ** draw.uniform(1.5, 2.6, draw.n), "level": draw.number(0.001, 0.01)}


CRITICAL_VALUE = function(
    "denoising.critical_value",
    {
        "degrees": Made(
            _any_degrees, corners=lambda t: np.array([1, 1.25, 1.5, 2, 3, 100, 1e6], t)
        ),
        "level": number(0.001, 0.5, (0.0, 1.0, -0.05, 1.5, nan)),
    },
    (
        close(
            "one",
            "With one degree of freedom it is Cauchy's: tan((1 - level) pi / 2)",
            lambda a, r: (r, found := np.tan((1 - a.level) * np.pi / 2), found),
            "The level is shared by both tails.",
            what="a critical value of",
            within=EXACT / EPSILON,
            case=lambda d: {"degrees": np.ones(d.n)},
        ),
        close(
            "normal",
            "With very many degrees it is the normal distribution's",
            lambda a, r: (r, found := -float(ndtri(a.level / 2)), found),
            "At the level 0.05 that is 1.96.",
            what="a critical value of",
            within=EXACT / EPSILON,
            case=lambda d: {"degrees": 10.0 ** d.rng.uniform(4, 6, d.n)},
        ),
        close(
            "hundreds",
            "With some hundred degrees it is not yet the normal distribution's",
            _exact,
            "Far out in the tails, Student's distribution takes thousands of degrees to become normal.",
            what="a critical value of",
            within=EXACT / EPSILON,
            case=_beyond_tables,
        ),
        holds(
            "falling",
            "With more degrees it is no larger",
            _falling,
            "a value that is no larger than that of fewer degrees",
            "Fewer samples say less about the variance, so more is left to chance.",
        ),
        close(
            "values",
            "Student's t exceeds it with the probability that is asked for",
            _exact,
            "Both tails together have the level. Degrees are no whole numbers, and small ones matter most.",
            what="a critical value of",
            within=EXACT / EPSILON,
            whole=True,
        ),
    ),
    scales=(1.0,),
    speed=20,
    # Any method will do: one that integrates the density at each step of a bisection is right, and slow.
    most=20,
)

# ---------------------------------------------------------------- pair_weights


def _tested(draw: Draw) -> Mapping[str, Any]:
    """Statistics on both sides of their critical values, and clear of them."""
    critical = draw.uniform(1, 5, 3, draw.n)
    inside = draw.rng.random((3, draw.n)) < 0.8
    part = np.where(
        inside, draw.uniform(0, 1 - CLEAR, 3, draw.n), draw.uniform(1 + CLEAR, 3, 3, draw.n)
    )
    return {
        "t": draw.rng.choice((-1.0, 1.0), (3, draw.n)) * part * critical,
        "critical": critical,
        "distance": draw.uniform(0, 4, draw.n),
        "sigma": draw.number(0.5, 4),
    }


def _gaussian(a: Arguments) -> Array:
    return np.asarray(np.exp(-((a.distance / a.sigma) ** 2) / 2))


def _weight(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, np.where((np.abs(a.t) <= a.critical).all(axis=0), _gaussian(a), 0), 1.0


def _one_channel(draw: Draw) -> Mapping[str, Any]:
    """Pairs that one channel separates."""
    made = dict(_tested(draw))
    # A pair may be of two pixels at one place.
    made["distance"][::4] = 0
    t = 0.5 * made["critical"]
    t[draw.rng.integers(0, 3, draw.n), np.arange(draw.n)] *= draw.rng.choice((-4.0, 4.0), draw.n)
    return made | {"t": t}


def _endless(draw: Draw) -> Mapping[str, Any]:
    t = np.zeros((3, draw.n))
    t[draw.rng.integers(0, 3, draw.n), np.arange(draw.n)] = draw.rng.choice((-inf, inf), draw.n)
    return {**_tested(draw), "t": t}


def _at_the_end(draw: Draw) -> Mapping[str, Any]:
    critical = draw.rng.choice((1.5, 2.0, 2.5), (3, draw.n))
    return {
        **_tested(draw),
        "critical": critical,
        "t": draw.rng.choice((-1.0, 1.0), (3, draw.n)) * critical,
    }


PAIR_WEIGHTS = function(
    "denoising.pair_weights",
    {"sigma": Made(wrong=(0.0, -1.0, nan))},
    (
        close(
            "own",
            "A pixel has the weight 1 in its own mean",
            lambda _, r: (r, 1.0),
            "At the distance 0 the Gaussian is 1: it isn't divided by its integral.",
            what="a weight of",
            case=lambda d: {**_tested(d), "t": np.zeros((3, d.n)), "distance": np.zeros(d.n)},
        ),
        close(
            "channel",
            "One channel is enough to separate two pixels, by a difference of either sign",
            lambda _, r: (r, 0.0),
            "All three channels have to agree, and the magnitude of t counts.",
            what="where one channel is over its critical value, a weight of",
            within=0,
            case=_one_channel,
            role="core",
        ),
        close(
            "infinite",
            "Infinite statistics separate",
            lambda _, r: (r, 0.0),
            "The magnitude of infinity is over every value. Infinity times 0 is no number: compare instead.",
            what="where t is infinite, a weight of",
            within=0,
            case=_endless,
        ),
        close(
            "end",
            "A statistic that is equal to its critical value does not separate",
            lambda a, r: (r, _gaussian(a), 1.0),
            "Only what is over it does.",
            what="where t is just the critical value, a weight of",
            case=_at_the_end,
        ),
        close(
            "values",
            "Weights are a Gaussian of the distance, or 0",
            _weight,
            "exp(-d^2 / (2 sigma^2)) for pairs that no channel separates.",
            what="a weight of",
            whole=True,
        ),
    ),
    case=_tested,
    scales=(1.0,),
)

# ---------------------------------------------------------------- weighted_mean

NEIGHBOURS = 7


def _neighbours(draw: Draw) -> Mapping[str, Any]:
    """Neighbours of pixels, the first of which is the pixel itself; a third of the others have no weight."""
    k = 3 if draw.simple else NEIGHBOURS
    weights = draw.uniform(0.25, 2, draw.n, k)
    weights[:, 1:] *= draw.rng.random((draw.n, k - 1)) > 0.3
    return {
        "means": draw.lengths(0.5, 4, 3, draw.n, k),
        "variances": draw.scale**2 * draw.uniform(0.5, 4, 3, draw.n, k),
        "weights": weights,
    }


def _averaged(a: Arguments, r: tuple[Array, Array]) -> tuple[Any, ...]:
    """Means and variances over their largest, one beside the other."""
    shares = a.weights / a.weights.sum(axis=1)[:, None]
    mean, variance = (a.means * shares).sum(axis=2), (a.variances * shares**2).sum(axis=2)
    sizes = [max(float(x.max(initial=0)), 1e-300) for x in (mean, variance)]
    found, expected = (
        np.concatenate([x / size for x, size in zip(pair, sizes, strict=True)])
        for pair in (r, (mean, variance))
    )
    return found, expected, 1.0


def _constant(draw: Draw) -> Mapping[str, Any]:
    made = dict(_neighbours(draw))
    return made | {"means": np.repeat(made["means"][..., :1], made["means"].shape[2], axis=2)}


def _evenly(draw: Draw) -> Mapping[str, Any]:
    made = dict(_neighbours(draw))
    same = np.repeat(made["variances"][..., :1], made["variances"].shape[2], axis=2)
    return made | {"variances": same, "weights": np.full(made["weights"].shape, 0.5)}


def _lonely(draw: Draw) -> Mapping[str, Any]:
    made = dict(_neighbours(draw))
    return made | {"weights": made["weights"] * (np.arange(made["weights"].shape[1]) == 0)}


def _hardly(draw: Draw) -> Mapping[str, Any]:
    """Small weights: shares are what counts."""
    made = dict(_neighbours(draw))
    return made | {"weights": made["weights"] * 10 ** draw.uniform(-15, 0, draw.n)[:, None]}


def _uneven(draw: Draw) -> Mapping[str, Any]:
    """Means of both signs, and weights of which some are a hundred thousandth of others."""
    made = dict(_neighbours(draw))
    shape = made["weights"].shape
    weights = 10 ** draw.uniform(-5, 0, *shape)
    return made | {"means": draw.lengths(-2, 4, 3, *shape), "weights": weights}


WEIGHTED_MEAN = function(
    "denoising.weighted_mean",
    {},
    (
        close(
            "constant",
            "Equal neighbours give what they are, whatever their weights",
            lambda a, r: (r[0], a.means[..., 0]),
            "Weights are divided by their sum.",
            what="among equal neighbours, a mean of",
            case=_constant,
        ),
        close(
            "alone",
            "A pixel whose neighbours have no weight keeps its mean and its variance",
            _averaged,
            "Its share is 1, whatever its weight.",
            what="(over the largest) a mean or, in rows 3 to 5, a variance of",
            case=_lonely,
        ),
        close(
            "uneven",
            "Small shares and negative means count, too",
            _averaged,
            "Nothing is cut off: a share is as small as it is.",
            what="(over the largest) a mean or, in rows 3 to 5, a variance of",
            case=_uneven,
        ),
        close(
            "hardly",
            "Small weights have the shares of large ones",
            _averaged,
            "In each row a weight is over 0, and so is their sum.",
            what="(over the largest) a mean or, in rows 3 to 5, a variance of",
            case=_hardly,
        ),
        close(
            "evenly",
            "k equal weights divide the variance by k",
            lambda a, r: (r[1], a.variances[..., 0] / a.means.shape[2]),
            "The variance of c x is c^2 times that of x.",
            what="of equal weights, a variance of",
            case=_evenly,
            role="core",
        ),
        close(
            "values",
            "Mean and variance are those of the weighted sum",
            _averaged,
            "Shares add up to 1. In the variance they are squared.",
            what="(over the largest) a mean or, in rows 3 to 5, a variance of",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_neighbours,
    scales=SCALES,
)

# ---------------------------------------------------------------- squared_bias


def _moved(draw: Draw) -> Mapping[str, Any]:
    mean = draw.lengths(0.5, 4, 3, draw.n)
    variance = draw.scale**2 * draw.uniform(0.5, 2, 3, draw.n)
    return {
        "filtered": mean + draw.lengths(-1, 1, 3, draw.n),
        "filtered_variance": variance * draw.uniform(0.05, 0.5, 3, draw.n),
        "mean": mean,
        "variance": variance,
        "share": draw.uniform(0, 1, draw.n),
    }


def _bias(a: Arguments, r: Array) -> tuple[Any, ...]:
    squared = (a.filtered - a.mean) ** 2
    size = np.abs(a.filtered * (a.filtered - a.mean)) + a.filtered_variance + a.variance
    return r, squared - (a.filtered_variance + a.variance - 2 * a.share * a.variance), size


def _bright(draw: Draw) -> Mapping[str, Any]:
    """Bright pixels that were moved by little."""
    made = dict(_moved(draw))
    mean = 1000 + draw.uniform(0, 1, 3, draw.n)
    variance = 1e-4 * made["variance"]
    return made | {
        "mean": mean,
        "filtered": mean + draw.uniform(-0.05, 0.05, 3, draw.n),
        "variance": variance,
        "filtered_variance": 1e-4 * made["filtered_variance"],
    }


def _unmoved(draw: Draw) -> Mapping[str, Any]:
    made = dict(_moved(draw))
    kept = {"filtered": made["mean"], "filtered_variance": made["variance"]}
    return made | kept | {"share": np.ones(draw.n)}


SQUARED_BIAS = function(
    "denoising.squared_bias",
    {},
    (
        close(
            "unmoved",
            "A pixel that is its own mean has no bias",
            lambda a, r: (r, 0.0, a.variance),
            "Its share is 1: what the two have in common is all of the variance.",
            what="of a pixel without neighbours, a squared bias of",
            case=_unmoved,
        ),
        close(
            "bright",
            "Of bright pixels a small move keeps its digits",
            _bias,
            "Subtract first, then square: squares of bright pixels have no digits left for a small difference.",
            what="of a bright pixel, a squared bias of",
            case=_bright,
        ),
        close(
            "negative",
            "It is negative where a pixel was moved by less than noise explains",
            lambda a, r: (r, -a.filtered_variance - (1 - 2 * a.share) * a.variance, a.variance),
            "Cut off at 0, the mean over pixels would be too large.",
            what="of a pixel that was not moved, a squared bias of",
            case=lambda d: {
                **(made := _moved(d)),
                "filtered": made["mean"],
                "share": np.zeros(d.n),
            },
        ),
        close(
            "values",
            "It is the squared move, less what noise explains",
            _bias,
            "Both have the pixel's own samples in common: their covariance is the share times the variance.",
            what="a squared bias of",
            scales=SCALES,
            whole=True,
        ),
    ),
    case=_moved,
    scales=SCALES,
)

FUNCTIONS = (
    *(WELCH_T, DEGREES_OF_FREEDOM, CRITICAL_VALUE),
    *(PAIR_WEIGHTS, WEIGHTED_MEAN, SQUARED_BIAS),
)
