"""Whether light comes to what rays have met: from lamps, from what emits, or over other surfaces."""

from collections.abc import Callable

import numpy as np

from course.engine.core.hits import Hits
from course.engine.core.lights.sample import Light
from course.engine.core.types import Floats, Floats32, Floats64, Indices, Mask
from course.engine.core.vectors import normalise
from course.engine.scene.lamp_points import faces, points_of, shines_at
from course.engine.terms.scattering.materials import FullMaterials
from course.engine.terms.world import FullWorld

BOUNCES = 8
"""That are followed where light goes from wall to wall."""

EVEN = np.array([[0.8191725], [0.6710436], [0.5497005]])
"""Inverse powers of the root of x^4 = x + 1."""

MOST = 64
"""Lights and their cells of which each is looked for."""

NEXT_TO = 0.99
"""Share of the way to a light up to which something shades it."""

Met = Callable[[Floats32, Floats32], Hits]
"""What rays from origins (3, n) or (3, 1) in directions (3, n) meet."""


def reached(world: FullWorld, met: Met, hits: Hits) -> bool:
    """True if light may come to any of the hits, straight from a light or, in path tracing, over other surfaces."""
    for bounce in range(1 if world.paths is None else BOUNCES):
        if _may_show_light(world, hits) or len(world.lights) > MOST:
            return True
        shaded = np.flatnonzero(world.materials.shaded.take(hits.material))
        origin, ng = (x.take(shaded, axis=1) for x in (hits.near_origin, hits.ng))
        if not len(shaded):
            return False
        # Even in three dimensions (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018): importing
        # NumPy's generators takes longer than all of this.
        u = ((np.arange(len(shaded)) + bounce / BOUNCES) * EVEN) % 1
        if any(_lit(world, met, light, hits, shaded, u) for light in world.lights):
            return True
        if world.paths is not None and _emitter_seen(world, met, origin, u):
            return True
        turn, z = 2 * np.pi * u[0], 2 * u[1] - 1
        sine = np.sqrt(1 - z * z)
        hits = met(origin, _unit(ng + np.stack((sine * np.cos(turn), sine * np.sin(turn), z))))
        if hits.size < len(shaded) and world.sky is not None:
            return True
        if not hits.size:
            return False
    return False


def _lit(
    world: FullWorld, met: Met, light: Light, hits: Hits, shaded: Indices, u: Floats64
) -> bool:
    """True if any of the hits ``shaded`` may see some point of a light, chosen by numbers u (3, n)."""
    p, ns = (x.take(shaded, axis=1) for x in (hits.p, hits.ns))
    which = np.flatnonzero(shines_at(light, p) & faces(light, p, ns))
    points, u = points_of(light), u[:, which]
    one, other = (points[:, (points.shape[1] * v).astype(np.intp)] for v in u[:2])
    return _sees(
        world, met, hits.near_origin.take(shaded[which], axis=1), one + u[2] * (other - one)
    )


def _emitter_seen(world: FullWorld, met: Met, origin: Floats32, u: Floats64) -> bool:
    """True if from any origin (3, n) a triangle is seen that emits, be it a light or not."""
    triangles = world.surface.triangles
    emitting = np.flatnonzero((world.materials.emission.max(axis=0) > 0).take(triangles.material))
    if not len(emitting):
        return False
    chosen = emitting[(len(emitting) * u[0]).astype(np.intp)]
    edges = triangles.edges[chosen].T
    return _sees(world, met, origin, triangles.planes[chosen, :3].T + (edges[:3] + edges[3:6]) / 3)


def _sees(world: FullWorld, met: Met, origin: Floats32, points: Floats64) -> bool:
    """True if nothing stands between any of n origins and its point, (3, n) each, but what emits or is next to it."""
    way = points - origin
    far = np.linalg.norm(way, axis=0)
    which = np.flatnonzero(far)
    hits = met(origin.take(which, axis=1), _unit(way.take(which, axis=1)))
    near = far[which] if hits.ray is None else far[which[hits.ray]]
    emits = (world.materials.emission.max(axis=0) > 0).take(hits.material)
    return hits.size < len(which) or bool((emits | (hits.t > NEXT_TO * near)).any())


def shining(world: FullWorld) -> Mask:
    """Which materials are seen without a light: they emit, show ambient light, or have a radiance of their own."""
    m = world.materials
    shines: Mask = (m.emission.max(0) > 0) | ((m.ambient * world.ambient[:, None]).max(0) > 0)
    if isinstance(m, FullMaterials) and m.unlit is not None:
        shines |= m.unlit.max(0) > 0
    return shines


def _may_show_light(world: FullWorld, hits: Hits) -> bool:
    """True if any of the hits shines by itself, or mirrors or refracts the light of other places."""
    m = world.materials
    shows = shining(world) | (m.mirror.max(0) > 0) | m.refracts
    return bool(shows.take(hits.material).any())


def _unit(x: Floats) -> Floats32:
    """Vectors (3, n) of length 1; those of length 0 stay so."""
    unit = x.astype(np.float32)
    normalise(unit)
    return unit
