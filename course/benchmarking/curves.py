"""What was measured of one estimator: its errors and times over the number of samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.benchmarking.estimators import Estimator
from course.benchmarking.orders import Order, fit_order
from course.core.types import Floats64


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
    def order(self) -> Order | None:
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
