"""Directions towards an environment's light by the functions of the `importance_sampling` module.

They are chosen about +z, turned to the surface, and weighed by the module's densities: a direction's share of the
irradiance over pi is its radiance times its cosine over pi times its density. Both ways have the same mean. Uniform
directions waste half of themselves near the horizon, where the cosine leaves little of the light.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Functions
from course.engine.terms.scattering.hemisphere import turned

WAYS = ("uniform_hemisphere", "cosine_hemisphere")
"""The functions that choose directions."""


@dataclass(frozen=True)
class HemisphereSampling:
    """One way to choose directions, or two of them: then each takes half of the numbers.

    Attributes
    ----------
    importance_sampling : functions of the module
    ways : the names of those that choose directions
    """

    importance_sampling: Functions
    ways: tuple[str, ...]

    def sample(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32]:
        """See ``course.engine.terms.environments.sky.SkySampling``."""
        if len(self.ways) == 1:
            local = self._chosen(self.ways[0], np.ascontiguousarray(u))
            cosine = np.ascontiguousarray(local[2])
            weight = _share(local[2], self._density(self.ways[0], cosine))
        else:
            local, weight = self._either(u)
        return turned(normal, *local), weight

    def _chosen(self, way: str, u: Floats32) -> Floats32:
        """Unit directions (3, n) about +z of numbers u (2, n)."""
        direction: Floats32
        if way == "uniform_hemisphere":
            direction = self.importance_sampling.uniform_hemisphere(u)
        else:
            direction = self.importance_sampling.cosine_hemisphere(u)
        return direction

    def _density(self, way: str, cosine: Floats32) -> Floats32:
        """Densities (n,) [1/sr] of directions with these cosines (n,)."""
        density: Floats32
        if way == "uniform_hemisphere":
            # The hemisphere is the lobe of exponent 0.
            density = self.importance_sampling.phong_lobe_pdf(cosine, 0.0)
        else:
            density = self.importance_sampling.cosine_hemisphere_pdf(cosine)
        return density

    def _either(self, u: Floats32) -> tuple[Floats32, Floats32]:
        """Directions (3, n) about +z by one of the two ways, and weights (n,)."""
        local, weight = np.empty((3, u.shape[1]), np.float32), np.empty(u.shape[1], np.float32)
        # The first number says which way; what is left of it is a number again.
        twice = u[0] + u[0]
        second = twice >= 1
        for number, which in enumerate((np.flatnonzero(~second), np.flatnonzero(second))):
            way, other = self.ways[number], self.ways[1 - number]
            half = np.stack((twice.take(which) - np.float32(number), u[1].take(which)))
            chosen = self._chosen(way, half)
            cosine = np.ascontiguousarray(chosen[2])
            mine = self._density(way, cosine)
            weights = self.importance_sampling.power_heuristic(mine, self._density(other, cosine))
            local[:, which] = chosen
            # Each way has half of the samples, so each of them counts twice.
            weight[which] = 2 * weights * _share(cosine, mine)
        return local, weight


def _share(cosine: Floats32, density: Floats32) -> Floats32:
    """Cosine over pi times density (n,), 0 where no direction is ever chosen."""
    scale = density * np.float32(np.pi)
    share: Floats32 = np.divide(cosine, scale, out=np.zeros_like(cosine), where=scale > 0)
    return share
