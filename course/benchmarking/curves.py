"""Measurements of one estimator: its errors and times by number of samples, and its order of convergence."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import stdtrit

from course.benchmarking.estimators import Estimator
from course.engine.core.types import Floats64

FIRST = 4
"""Samples from which an order is fitted: with fewer, an error says little about the next one."""

CLEAR = 4.0
"""Errors count that are this many times the reference's own: then it adds at most 3% to them."""

RESAMPLES = 1000
CONFIDENCE = 0.95


@dataclass(frozen=True)
class ConvergenceOrder:
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


def fit_order(samples: Floats64, mse: Floats64, floor: float = 0.0) -> ConvergenceOrder | None:
    """Fit an order by least squares on logarithmic scales, and its interval by the bootstrap over seeds.

    Returns None where fewer than 3 points count. With one seed the interval is infinite.

    Whole columns are resampled, for points of one seed may share their first samples. The interval is the estimate
    plus or minus t times the bootstrap's standard error, corrected by sqrt(s / (s - 1)) for s seeds: percentiles of
    so few seeds would be too narrow (Hesterberg, "What teachers should know about the bootstrap", 2015). It speaks of
    noise only; where the points don't lie on a line, the slope is a mean over the range that was fitted.

    Parameters
    ----------
    samples : (n,) numbers of samples, ascending
    mse : (n, seeds) mean squared errors; a column belongs to one seed
    floor : RMSE of the reference itself; points that are not clearly above it don't count, nor those of less than
        4 samples
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
        student = float(stdtrit(seeds - 1, 0.5 + CONFIDENCE / 2))
        spread = student * correction * float(slopes.std())
    used = samples[counts]
    return ConvergenceOrder(slope, slope - spread, slope + spread, int(used[0]), int(used[-1]))


@dataclass(frozen=True)
class Converged:
    """The reference of an integral, as reports state it.

    Attributes
    ----------
    key : hash of all that decides it
    error : its own RMSE
    samples : a pixel
    """

    key: str
    error: float
    samples: int


@dataclass(frozen=True)
class Curve:
    """Errors and times of one estimator.

    Attributes
    ----------
    samples : (n,) a pixel
    mse, relative_mse, dissimilarity : (n, seeds)
    seconds : (n, seeds) from the call to the picture
    bias : (n,) RMSE of the mean over all seeds, without what their number and the reference leave of noise
    """

    estimator: Estimator
    reference: Converged
    samples: Floats64
    mse: Floats64
    relative_mse: Floats64
    dissimilarity: Floats64
    seconds: Floats64
    bias: Floats64

    @property
    def rmse(self) -> Floats64:
        """(n,) root of the mean of all squared errors."""
        root: Floats64 = np.sqrt(self.mse.mean(axis=1))
        return root

    @property
    def time(self) -> Floats64:
        """(n,) median seconds."""
        median: Floats64 = np.median(self.seconds, axis=1)
        return median

    @property
    def efficiency(self) -> Floats64:
        """(n,) 1 / (MSE x seconds); infinite where there is no error."""
        with np.errstate(divide="ignore"):
            inverse: Floats64 = 1 / (self.mse.mean(axis=1) * self.time)
        return inverse

    @property
    def order(self) -> ConvergenceOrder | None:
        """The fitted convergence order; None where too few errors are clearly above the reference's."""
        return fit_order(self.samples, self.mse, self.reference.error)

    def to_dict(self) -> dict[str, Any]:
        """Plain data; None stands for what is not finite."""
        order = self.order
        return {
            "estimator": self.estimator.name,
            "sampler": self.estimator.sampler,
            "integral": self.estimator.integral,
            "biased": self.estimator.biased,
            "samples": self.samples.astype(int).tolist(),
            "points_a_sample": self.estimator.points,
            "rmse": _plain(self.rmse),
            "relative_mse": _plain(self.relative_mse.mean(axis=1)),
            "dissimilarity": _plain(self.dissimilarity.mean(axis=1)),
            "bias": _plain(self.bias),
            "seconds": _plain(self.time),
            "efficiency": _plain(self.efficiency),
            "order": None
            if order is None
            else {
                "value": order.value,
                "interval": _plain(np.array([order.low, order.high])),
                "samples": [order.first, order.last],
            },
            "mse_by_seed": self.mse.tolist(),
            "seconds_by_seed": self.seconds.tolist(),
        }


def _plain(values: Floats64) -> list[float | None]:
    return [float(x) if np.isfinite(x) else None for x in values]
