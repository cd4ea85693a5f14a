"""Light from the environment on diffuse surfaces: one direction with the density of the cosine, one occlusion query.

With that density the mean of the radiance that arrives unhindered is the irradiance over pi.
"""

from __future__ import annotations

import numpy as np

from course.core.hemisphere import cosine_directions
from course.core.types import Floats32, Indices
from course.core.vectors import dot
from course.geometry.hits import Hits
from course.scene.world import World
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
    u = draws("environment", dimension, 2, path)
    direction = cosine_directions(hits.ns, u)
    outwards = dot(direction, hits.ng) > 0
    if not world.materials.diffuses.all():
        outwards &= world.materials.diffuses.take(hits.material)
    which = np.flatnonzero(outwards)
    if len(which) == 0:
        return None
    chosen = direction.take(which, axis=1)
    draws.counters.rays["shadow"] += len(which)
    free = world.surface.accelerator.unoccluded(
        hits.above.take(which, axis=1),
        chosen,
        FAR,
        draws.counters.embree,
        None if hits.time is None else hits.time.take(which),
    )
    result = np.zeros((3, hits.size), np.float32)
    result[:, which] = world.environment.radiance(chosen) * free
    return result
