"""Light from the environment on diffuse surfaces: one direction for each hit, one occlusion query.

A sampling chooses the directions. Radiance times cosine over pi times density, where nothing is in the way, has
the irradiance over pi as its mean.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from course.engine.core.environment import Environment
from course.engine.core.hits import Hits, Surface
from course.engine.core.rays import Draws
from course.engine.core.types import Floats32, Indices, Mask
from course.engine.core.vectors import dot
from course.engine.terms.scattering.hemisphere import cosine_directions

FAR = 1e30

NUMBERS = ("environment", 2)
"""Name and width of the numbers that one direction takes."""

COST = 8.0
"""A direction of the environment, its radiance, and the ray there, in camera rays that meet nothing."""


class SkySampling(Protocol):
    """A way to choose directions that light may come from."""

    def sample(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32 | None]:
        """Directions for the irradiance over pi.

        Parameters
        ----------
        normal : (3, n) float32, unit length
        u : (2, n) float32 in [0, 1)

        Returns
        -------
        direction : (3, n) float32, unit length
        weight : (n,) float32, cosine over pi times density, not above 0 below the horizon; None where it is 1
            everywhere
        """
        ...


class CosineSampling:
    """Directions as dense as their cosine."""

    def sample(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32 | None]:
        """See ``SkySampling``."""
        return cosine_directions(normal, u), None


@dataclass(frozen=True)
class Sky:
    """An environment that lights diffuse surfaces.

    Attributes
    ----------
    diffuses : (M,) which materials have a diffuse term
    refracts : (M,) which are dielectrics, whose inside shows no light from outside
    """

    surface: Surface
    environment: Environment
    sampling: SkySampling
    diffuses: Mask
    refracts: Mask

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Irradiance over pi (3, n) from the environment at the hits; None where none arrives.

        ``path``: (n,) the path of each hit, or None for all paths of the block in order
        """
        which, ns, ng = np.arange(hits.size), hits.ns, hits.ng
        glass = bool((self.diffuses & self.refracts).any())
        if glass or not self.diffuses.all():
            shows = self.diffuses.take(hits.material)
            if glass:
                shows &= hits.entering | ~self.refracts.take(hits.material)
            which = np.flatnonzero(shows)
            if len(which) == 0:
                return None
            ns, ng = ns.take(which, axis=1), ng.take(which, axis=1)
            path = which if path is None else path.take(which)
        u = draws("environment", path, depth)
        direction, weight = self.directions(ns, u)
        outwards = dot(direction, ng) > 0
        if weight is not None:
            outwards &= weight > 0
        chosen = np.flatnonzero(outwards)
        direction, which = direction.take(chosen, axis=1), which.take(chosen)
        draws.cast("shadow", len(which), path, chosen, COST)
        free = self.surface.accelerator.unoccluded(
            hits.near_origin.take(which, axis=1),
            direction,
            FAR,
            draws.counters.embree,
            None if hits.time is None else hits.time.take(which),
        )
        seen = np.flatnonzero(free)
        if len(seen) == 0:
            return None
        radiance = self.environment.radiance(direction.take(seen, axis=1))
        if weight is not None:
            radiance = radiance * weight.take(chosen.take(seen))
        result = np.zeros((3, hits.size), np.float32)
        result[:, which.take(seen)] = radiance
        return result

    def directions(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32 | None]:
        """See ``SkySampling.sample``."""
        return self.sampling.sample(normal, u)
