"""Reconstruction: from the samples of a pixel to its colour, through the `supersampling` module."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32

Resolve = Callable[[Floats32, Floats32], Floats32]
GaussianWeights = Callable[[Floats32, float], Floats32]


@dataclass(frozen=True)
class Reconstruction:
    """A filter no wider than the pixel.

    Attributes
    ----------
    resolve : the module's weighted mean; None where each pixel has a single sample, which needs none
    gaussian_weights : the module's weights; None for the box filter
    sigma : float [pixels], of the Gaussian
    """

    resolve: Resolve | None
    gaussian_weights: GaussianWeights | None
    sigma: float

    def pixels(self, radiance: Floats32, offsets: Floats32) -> tuple[Floats32, Floats32 | float]:
        """Colour and weight of each pixel of a block.

        Parameters
        ----------
        radiance : (3, n, s) float32
        offsets : (2, n, s) float32, where the samples lie in their pixels

        Returns
        -------
        mean : (3, n) float32
        weight : (n,) float32 or one number, the sum of the weights behind the mean
        """
        n, s = radiance.shape[1:]
        weights = _ones(n, s)
        total: Floats32 | float = float(s)
        if self.gaussian_weights is not None:
            weights = self.gaussian_weights(offsets, self.sigma)
            total = weights.sum(axis=1)
        if self.resolve is None:
            return radiance[:, :, 0], total
        return self.resolve(radiance, weights), total


def _ones(n: int, s: int) -> Floats32:
    return np.ones((n, s), np.float32)
