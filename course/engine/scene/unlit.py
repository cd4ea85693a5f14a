"""Why no light comes to what is seen: what stands around the eye or a lamp, before the lamps, or turned away."""

from collections.abc import Sequence

import numpy as np

from course.engine.core.hits import Hits
from course.engine.core.lights.sample import Light
from course.engine.core.types import Floats32, Floats64
from course.engine.scene.finding_light import Met
from course.engine.scene.lamp_points import AROUND, cone_of, faces, points_of, shines_at
from course.engine.scene.scene import Scene
from course.engine.terms.world import FullWorld

LIKELY = "the picture is likely to be black: "


def solids_around(scene: Scene, place: Floats32, around: Hits, lights: Sequence[Light] = ()) -> str:
    """The objects around a place (3, 1) whose material is met on all sides; empty if a light is in the box of one."""
    names = list(scene.loaded.description.materials)
    met = {names[number] for number in np.unique(around.material) if number < len(names)}
    found = []
    for number, thing in enumerate(scene.loaded.description.objects):
        low, high = scene.compiled.frame.position(scene.compiled.bounds[number])[:, :, None]

        def holds(points: Floats32, low: Floats64 = low, high: Floats64 = high) -> bool:
            return bool(((low <= points) & (points <= high)).all(axis=0).any())

        if thing.material not in met or not holds(place):
            continue
        if any(holds(points_of(light)) for light in lights):
            return ""
        found.append(f"{thing.name or thing.__struct_config__.tag} (objects.{number})")
    return " and ".join(found) if around.size == AROUND.shape[1] else ""


def locked_in(scene: Scene, met: Met) -> str:
    """Which light is inside something; empty if none is."""
    for light in scene.compiled.world.lights:
        points = points_of(light)
        middle = points.mean(axis=1, keepdims=True)
        # From outside a lamp that is a surface itself.
        beyond = 1.01 * np.linalg.norm(points - middle, axis=0).max() * AROUND
        around = met((middle + beyond).astype(np.float32), AROUND)
        if inside := solids_around(scene, middle, around):
            return (
                f"{LIKELY}{light.name} is inside {inside}, which lets no light out; move the light"
            )
    return ""


def hidden(world: FullWorld) -> str:
    """Why no light comes to what is seen, though some of it is turned to the lights, if there are any."""
    if not world.lights and world.paths is None:
        if world.environment is not None:
            return (
                f"{LIKELY}the environment lights no surface; set environment.lights, or add a light"
            )
        return (
            f"{LIKELY}what emits light lights nothing else: add {{type: object, object: its name}} to lights,"
            " or set integrator.type to path"
        )
    names = ", ".join([light.name for light in world.lights][:3]) or "what emits light"
    return f"{LIKELY}all that is seen lies in shadow: something stands before {names}"


def turned_from(scene: Scene, seen: Hits) -> str:
    """Why none of the lights lights any of the hits; empty if one would, were nothing in its way."""
    lights = scene.compiled.world.lights
    if not any(shines_at(light, seen.p).any() for light in lights):
        names = [light.name for light in lights]
        ways = ["turn the direction of spots"] if any(cone_of(light) for light in lights) else []
        if not all(cone_of(light) for light in lights):
            ways.append("exchange edge_u and edge_v, or set two_sided")
        return (
            f"{LIKELY}nothing that is seen is in front of a light "
            f"({', '.join(names[:3])}{', ...' if len(names) > 3 else ''}): {', or '.join(ways)}"
        )
    if not any(
        (shines_at(light, seen.p) & faces(light, seen.p, seen.ns)).any() for light in lights
    ):
        return f"{LIKELY}all that is seen is turned away from the lights"
    return ""
