"""Reconstruction: from the samples of a pixel to its colour, by the module ``supersampling``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.core.functions import Functions
from course.core.types import Floats32


@dataclass(frozen=True)
class Reconstruction:
    """A filter no wider than the pixel.

    Attributes
    ----------
    supersampling : functions of that module
    single : whether each pixel has one sample, which is its colour
    sigma : standard deviation of the Gaussian [pixels]; None for the box filter
    """

    supersampling: Functions
    single: bool
    sigma: float | None

    def pixels(self, radiance: Floats32, offsets: Floats32) -> tuple[Floats32, Floats32 | float]:
        """Colour and weight of each pixel of a block.

        Parameters
        ----------
        radiance : (3, n, s) float32 of s samples in each of n pixels
        offsets : (2, n, s) float32 [pixels], positions of the samples in their pixels

        Returns
        -------
        mean : (3, n) float32
        weight : (n,) float32 or one number, sum of the samples' weights
        """
        n, s = radiance.shape[1:]
        weights: Floats32 = np.ones((n, s), np.float32)
        total: Floats32 | float = float(s)
        if self.sigma is not None:
            weights = self.supersampling.gaussian_weights(offsets, self.sigma)
            total = weights.sum(axis=1)
        if self.single:
            return radiance[:, :, 0], total
        return self.supersampling.resolve(radiance, weights), total
