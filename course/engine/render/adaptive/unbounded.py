"""What no number of samples bounds: light that may be rare and bright, and that nobody knows the place of beforehand.

The estimate of the error knows of such light only what samples have found. So it is told, by name, where a scene has
it; it needn't be in the picture.
"""

from collections.abc import Iterable

import numpy as np

from course.engine.core.environment import CubeEnvironment
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import SceneDescription
from course.engine.render.adaptive.bright import Bright
from course.engine.render.adaptive.lobes_ahead import Surfaces
from course.engine.scene.building.materials import material_columns
from course.engine.terms.world import FullWorld

RARE = 1 / 64
"""A thing is small if so few of all directions lead to it, seen from a distance of half the scene's size."""

NAMED = 3
"""Things and materials of a kind that are named."""


def unbounded(
    scene: SceneDescription,
    world: FullWorld,
    things: list[Bright],
    bright: float,
    deepest: int,
    cut_short: Iterable[int],
    footprint: float,
) -> tuple[str, ...]:
    """What an estimate of the error doesn't bound, a line for each cause.

    Parameters
    ----------
    bright : mean square of a radiance from which on a single pixel of it matters
    deepest : surfaces that rays meet after the first, at most
    cut_short : materials at which rays sent ahead weren't followed further
    footprint : how wide a pixel, or what a lens makes of it, is at a distance of 1
    """
    small = [one for one in things if one.square > bright and one.area < 4 * np.pi * RARE]
    lamps = _listed(_thing(scene, one.material) for one in small)
    sky = _has_small_lights(world, bright)
    told = []
    if sky:
        lamps = _listed([*([lamps] if lamps else []), "small lights of the environment"])
        if _texel(world) < footprint / 2:
            told.append("small lights of the environment, smaller than pixels")
    if not lamps or not deepest:
        return tuple(told)
    sends_on = np.flatnonzero(Surfaces(world).sends_on)
    paths = world.paths
    if paths is not None and world.materials.diffuses.any():
        if len(sends_on):
            by = _listed(_thing(scene, number) for number in sends_on.tolist())
            told.append(f"caustics, light of {lamps} by way of {by}")
        sought = paths.lamps | paths.objects
        chance = [_thing(scene, one.material) for one in small if not sought[one.material]]
        if sky and world.sky is None:
            chance.append("small lights of the environment")
        if chance:
            told.append(f"light of {_listed(chance)}, which paths find by chance alone")
    elif sky and len(sends_on):
        by = _listed(_thing(scene, number) for number in sends_on.tolist())
        told.append(f"images of small lights of the environment in {by}")
    if deepest > 1 and small and (further := sorted(set(cut_short))):
        by = _listed(_thing(scene, number) for number in further)
        told.append(f"images of {_listed(_thing(scene, one.material) for one in small)} in {by}")
    return tuple(told)


def _has_small_lights(world: FullWorld, bright: float) -> bool:
    """Whether few directions of the environment are so bright that a single pixel of them matters."""
    environment = world.environment
    if not isinstance(environment, CubeEnvironment):
        return False
    square = (environment.faces.astype(np.float64) ** 2).mean(axis=-1)
    return 0 < float((square > max(bright, 4 * float(square.mean()))).mean()) < RARE


def _texel(world: FullWorld) -> float:
    """How wide one of a cube map's texels is at a distance of 1, in the middle of a face."""
    assert isinstance(world.environment, CubeEnvironment)
    return 2 / len(world.environment.faces[0])


def _thing(scene: SceneDescription, material: int) -> str:
    """What a material of the world is called in the scene: an object that has it, or a light."""
    columns = material_columns(scene)
    if material >= len(columns.names):
        seen = [
            number
            for number, light in enumerate(scene.lights)
            if isinstance(light, d.SphereLight | d.RectangleLight)
            and light.radiance is not None
            and getattr(light, "visible", True)
        ]
        return f"light {seen[material - len(columns.names)]}"
    things = [
        thing.name
        for thing, column in zip(scene.objects, columns.of_objects, strict=True)
        if column == material and thing.name
    ]
    return things[0] if len(things) == 1 else f"material {columns.names[material]}"


def _listed(names: Iterable[str]) -> str:
    """Names, each once, the first few of them."""
    found = list(dict.fromkeys(names))
    return ", ".join(found[:NAMED]) + (", ..." if len(found) > NAMED else "")
