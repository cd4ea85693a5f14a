"""Directions towards an environment's light by the functions of the `importance_sampling` module.

They are chosen about +z, turned to the surface, and weighed by the module's densities: a direction's share of the
irradiance over pi is its radiance times its cosine over pi times its density. Both ways have the same mean. Uniform
directions waste half of themselves near the horizon, where the cosine leaves little of the light.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.hemisphere import turned
from course.core.types import Floats32

Choose = Callable[[Floats32], Floats32]
"""u (2, n) -> unit directions (3, n) about +z."""

Density = Callable[[Floats32], Floats32]
"""Cosines (n,) -> densities (n,) [1/sr]."""

Heuristic = Callable[[Floats32, Floats32], Floats32]
"""Densities (n,) of the way that was taken, and of the other -> weights (n,)."""


@dataclass(frozen=True)
class HemisphereSampling:
    """One way to choose directions, or two of them: then each takes half of the numbers.

    Attributes
    ----------
    ways : functions that choose, each with its density
    heuristic : weighs what two ways say; None where there is one
    """

    ways: tuple[tuple[Choose, Density], ...]
    heuristic: Heuristic | None = None

    def sample(
        self, normal: Floats32, u: Floats32, compiled: bool = False
    ) -> tuple[Floats32, Floats32]:
        """See ``ConstantEnvironment.sample``; there are no compiled loops."""
        if self.heuristic is None:
            ((choose, density),) = self.ways
            local = choose(np.ascontiguousarray(u))
            weight = _share(local[2], density(np.ascontiguousarray(local[2])))
        else:
            local, weight = self._either(u, self.heuristic)
        return turned(normal, *local), weight

    def _either(self, u: Floats32, heuristic: Heuristic) -> tuple[Floats32, Floats32]:
        """Directions (3, n) about +z by one of the two ways, and weights (n,)."""
        local, weight = np.empty((3, u.shape[1]), np.float32), np.empty(u.shape[1], np.float32)
        # The first number says which way; what is left of it is a number again.
        twice = u[0] + u[0]
        second = twice >= 1
        for way, which in enumerate((np.flatnonzero(~second), np.flatnonzero(second))):
            (choose, density), (_, other) = self.ways[way], self.ways[1 - way]
            chosen = choose(np.stack((twice.take(which) - np.float32(way), u[1].take(which))))
            cosine = np.ascontiguousarray(chosen[2])
            mine = density(cosine)
            local[:, which] = chosen
            # Each way has half of the samples, so each of them counts twice.
            weight[which] = 2 * heuristic(mine, other(cosine)) * _share(cosine, mine)
        return local, weight


def _share(cosine: Floats32, density: Floats32) -> Floats32:
    """Cosine over pi times density (n,), 0 where no direction is ever chosen."""
    scale = density * np.float32(np.pi)
    share: Floats32 = np.divide(cosine, scale, out=np.zeros_like(cosine), where=scale > 0)
    return share
