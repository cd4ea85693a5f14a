"""What a scene holds and what rendering it will ask for, for people."""

from __future__ import annotations

from collections import Counter

from course.scene.needs import needs_of, skipped_modules
from course.scene.scene import Scene
from course.transport.plan import make_plan


def summarize(scene: Scene) -> dict[str, dict[str, object]]:
    """Sections of labels and values; nothing is rendered."""
    description, settings = scene.loaded.description, scene.settings
    compiled, world = scene.compiled, scene.compiled.world
    plan = make_plan(world, settings)
    needs = needs_of(scene.loaded, settings, scene.compiled.world.materials)
    frame = compiled.frame
    dimensions = {"pixel": "2 numbers a sample"}
    for light in world.lights:
        if light.width:
            dimensions[light.name] = f"{light.width} numbers a sample and bounce"
    kinds = Counter(light.__struct_config__.tag for light in description.lights)
    shapes = Counter(thing.__struct_config__.tag for thing in description.objects)
    skipped = {**skipped_modules(needs), **world.skipped_lights}
    return {
        "scene": {
            "title": scene.title,
            "picture": f"{settings.width} x {settings.height} pixels",
            "samples": f"{settings.samples} a pixel, {settings.sampler}",
            "bounces": plan.max_depth,
        },
        "objects": {
            **{str(shape): number for shape, number in shapes.items()},
            "triangles": sum(compiled.triangles),
            "materials": len(description.materials),
            "center": "{:g} {:g} {:g}".format(*frame.center),
            "half extent": f"{frame.scale:g}",
        },
        "lights": {str(kind): number for kind, number in kinds.items()},
        "sampled": dict(dimensions),
        "effects": {
            **{
                f"calls {need.function}": scene.loaded.document.where(need.asked_by)
                for need in needs
            },
            **{f"skips {name}": reason for name, reason in skipped.items()},
        },
    }
