"""What no number of samples bounds: light that may be rare and bright, and that nobody knows the place of beforehand.

The estimate of the error knows of such light only what samples have found. So it is told, by name, where a scene has
it; it needn't be in the picture.
"""

from collections.abc import Iterable

import numpy as np

from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import SceneDescription
from course.engine.render.adaptive.bright import Bright
from course.engine.render.adaptive.bright_sky import RARE, small_lights
from course.engine.render.adaptive.lobes_ahead import Surfaces
from course.engine.scene.building.materials import material_columns
from course.engine.terms.world import FullWorld

NAMED = 3
"""Things and materials of a kind that are named."""


def unbounded(
    scene: SceneDescription,
    world: FullWorld,
    things: list[Bright],
    bright: float,
    deepest: int,
    cut_short: Iterable[int],
) -> tuple[str, ...]:
    """What an estimate of the error doesn't bound, a line for each cause.

    Parameters
    ----------
    bright : mean square of a radiance from which on a single pixel of it matters
    deepest : surfaces that rays meet after the first, at most
    cut_short : materials at which rays sent ahead weren't followed further, or that they may have missed
    """
    # Seen from a distance of half the scene's size, or from the scene's middle.
    small = [
        one
        for one in things
        if one.square > bright and one.area < 4 * np.pi * RARE * max(one.far(world), 1) ** 2
    ]
    lamps = _listed(_thing(scene, one.material) for one in small)
    sky = small_lights(world, bright) is not None
    told = list[str]()
    if sky:
        lamps = _listed([*([lamps] if lamps else []), "small lights of the environment"])
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
    if small and (further := sorted(set(cut_short))):
        by = _listed(_thing(scene, number) for number in further)
        told.append(f"images of {_listed(_thing(scene, one.material) for one in small)} in {by}")
    return tuple(told)


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
