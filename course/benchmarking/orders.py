"""Convergence orders: the slope of the error over the number of samples, on logarithmic scales, with its interval."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from course.core.types import Floats64

FIRST = 4
"""Samples from which an order is fitted: with fewer, an error says little about the next one."""

CLEAR = 4.0
"""Errors count that are this many times the reference's own: then it adds at most 3% to them."""

RESAMPLES = 1000
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Order:
    """A fitted convergence order: the error goes as samples^value.

    Attributes
    ----------
    value : the slope, -0.5 for independent random samples
    low, high : its 95% confidence interval
    first, last : the numbers of samples between which it was fitted
    """

    value: float
    low: float
    high: float
    first: int
    last: int


def fit_order(samples: Floats64, mse: Floats64, floor: float = 0.0) -> Order | None:
    """Fit an order by least squares on logarithmic scales, and its interval by the bootstrap over seeds.

    Parameters
    ----------
    samples : (n,) numbers of samples, ascending
    mse : (n, seeds) mean squared errors; a column belongs to one seed
    floor : RMSE of the reference itself; points that are not clearly above it don't count, nor those of less than
        4 samples

    Returns
    -------
    Order or None
        None where fewer than 3 points count. With one seed the interval is infinite.

    Notes
    -----
    Whole columns are resampled, for points of one seed may share their first samples. The interval is the estimate
    plus or minus t times the bootstrap's standard error, corrected by sqrt(s / (s - 1)) for s seeds: percentiles of
    so few seeds would be too narrow (Hesterberg, "What teachers should know about the bootstrap", 2015). It speaks of
    noise only; where the points don't lie on a line, the slope is a mean over the range that was fitted.
    """
    mean = np.sqrt(mse.mean(axis=1))
    counts = (samples >= FIRST) & (mean > CLEAR * floor)
    if counts.sum() < 3 or (mean[counts] <= 0).any():
        return None
    x, y = np.log(samples[counts]), mse[counts]
    x = x - x.mean()
    seeds = mse.shape[1]
    slope = float(x @ (0.5 * np.log(y.mean(axis=1))) / (x @ x))
    spread = math.inf
    if seeds > 1:
        rng = np.random.default_rng(1)
        weights = rng.multinomial(seeds, np.full(seeds, 1 / seeds), RESAMPLES).T / seeds
        slopes = x @ (0.5 * np.log(y @ weights)) / (x @ x)
        correction = math.sqrt(seeds / (seeds - 1))
        spread = _quantile(seeds - 1) * correction * float(slopes.std())
    used = samples[counts]
    return Order(slope, slope - spread, slope + spread, int(used[0]), int(used[-1]))


def _quantile(freedom: int) -> float:
    """Student's t for the two-sided confidence, from 3 degrees of freedom on to 1%; else from its closed forms."""
    p = 0.5 + CONFIDENCE / 2
    if freedom == 1:
        return math.tan(math.pi * (p - 0.5))
    if freedom == 2:
        return (2 * p - 1) / math.sqrt(2 * p * (1 - p))
    z = NormalDist().inv_cdf(p)
    # Abramowitz & Stegun 26.7.5.
    terms = (
        (z**3 + z) / 4,
        (5 * z**5 + 16 * z**3 + 3 * z) / 96,
        (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384,
    )
    more: float = sum(term / freedom**power for power, term in enumerate(terms, start=1))
    return z + more
