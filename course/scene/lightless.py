"""Scenes in which nothing shines: their pictures are black for certain."""

from __future__ import annotations

from typing import get_args

from course.building.light_power import power
from course.formats.yaml import description as d
from course.scene.scene import Scene


def why_black(scene: Scene) -> str:
    """Say why every picture of a scene is black for want of light; empty where there is some."""
    world, lights = scene.compiled.world, scene.loaded.description.lights
    seen = world.materials.ambient * world.ambient[:, None] + world.materials.emission
    if world.lights or seen.any() or not world.environment.black:
        return ""
    if not lights:
        kinds = ", ".join(str(kind.__struct_config__.tag) for kind in get_args(d.Light))
        return (
            "the picture will be black: the scene has no lights, and its environment is black; "
            f"known are {kinds}, such as {{type: ambient, radiance: 1}}"
        )
    reasons = dict(world.skipped_lights)
    for number, light in enumerate(lights):
        if isinstance(light, d.AmbientLight):
            dark = not power(light).any()
            reasons[f"light {number}"] = (
                "it has no power" if dark else "no material has an ambient term"
            )
    listed = [f"{name}: {reason}" for name, reason in list(reasons.items())[:3]]
    return (
        "the picture will be black: the environment is black, and no light shows anything "
        f"({'; '.join(listed)}{'; ...' if len(reasons) > 3 else ''})"
    )
