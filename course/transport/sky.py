"""Light from the environment on diffuse surfaces: one direction for each hit, one occlusion query.

The environment chooses the directions. Radiance times cosine over pi times density, where nothing is in the way, has
the irradiance over pi as its mean.
"""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Indices
from course.core.vectors import dot
from course.geometry.hits import Hits
from course.scene.world import World
from course.transport import costs
from course.transport.paths import Draws

FAR = 1e30


def skylight(
    world: World, hits: Hits, path: Indices | None, dimension: int, draws: Draws
) -> Floats32 | None:
    """Irradiance over pi (3, n) from the environment at the hits; None where none arrives.

    Parameters
    ----------
    path : (n,) the path of each hit, or None for all paths of the block in order
    dimension : the first of the two dimensions of this bounce's sky
    """
    which, ns, ng = np.arange(hits.size), hits.ns, hits.ng
    diffuses, refracts = world.materials.diffuses, world.materials.refracts
    glass = bool((diffuses & refracts).any())
    if glass or not diffuses.all():
        shows = diffuses.take(hits.material)
        if glass:
            # The inside of glass shows no light from outside.
            shows &= hits.entering | ~refracts.take(hits.material)
        which = np.flatnonzero(shows)
        if len(which) == 0:
            return None
        ns, ng = ns.take(which, axis=1), ng.take(which, axis=1)
        path = which if path is None else path.take(which)
    u = draws("environment", dimension, 2, path)
    direction, weight = world.environment.sample(ns, u, hits.compiled)
    outwards = dot(direction, ng) > 0
    if weight is not None:
        outwards &= weight > 0
    chosen = np.flatnonzero(outwards)
    direction, which = direction.take(chosen, axis=1), which.take(chosen)
    draws.counters.rays["shadow"] += len(which)
    draws.spend(costs.SKY_RAY, path, chosen)
    free = world.surface.accelerator.unoccluded(
        hits.above.take(which, axis=1),
        direction,
        FAR,
        draws.counters.embree,
        None if hits.time is None else hits.time.take(which),
    )
    seen = np.flatnonzero(free)
    if len(seen) == 0:
        return None
    radiance = world.environment.radiance(direction.take(seen, axis=1))
    if weight is not None:
        radiance = radiance * weight.take(chosen.take(seen))
    result = np.zeros((3, hits.size), np.float32)
    result[:, which.take(seen)] = radiance
    return result
