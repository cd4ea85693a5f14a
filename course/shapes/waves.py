"""A smooth random function with a known gradient: a mean of sine waves in all directions."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

WAVES = 8


@dataclass(frozen=True)
class Waves:
    """f(x) = mean over k of sin(vectors[k] . x + phases[k]), so that |f| <= 1.

    Attributes
    ----------
    vectors : (K, D) float64
        Wave vectors [rad per unit of x].
    phases : (K,) float64
        [rad]
    """

    vectors: NDArray[np.float64]
    phases: NDArray[np.float64]

    def __call__(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return f (V,) and its gradient (V, D) at `points` (V, D)."""
        value = np.zeros(len(points))
        gradient = np.zeros(points.shape)
        # One wave at a time: a lattice may have millions of points.
        for vector, phase in zip(self.vectors, self.phases, strict=True):
            angle = np.sum(points * vector, axis=1) + phase
            value += np.sin(angle)
            gradient += np.cos(angle)[:, None] * vector
        return value / len(self.phases), gradient / len(self.phases)


def random_waves(seed: int, dimensions: int, wave_number: float) -> Waves:
    """Return waves of `wave_number` / 2 to `wave_number` [rad per unit], in 2 or 3 dimensions.

    Python's own generator draws them: its `random()` is the same for a seed in every version,
    which NumPy's generators don't promise.
    """
    draw = random.Random(seed).random
    vectors, phases = [], []
    for k in range(WAVES):
        height = 2.0 * draw() - 1.0 if dimensions == 3 else 0.0
        across = math.sqrt(1.0 - height * height)
        azimuth = 2.0 * math.pi * draw()
        number = wave_number * (1.0 - 0.5 * k / (WAVES - 1))
        direction = (across * math.cos(azimuth), across * math.sin(azimuth), height)
        vectors.append([number * x for x in direction[:dimensions]])
        phases.append(2.0 * math.pi * draw())
    return Waves(np.array(vectors), np.array(phases))
