"""A summary of a scene for people: its contents, and the functions that rendering calls."""

from collections import Counter

import numpy as np

from course.engine.formats.yaml.document import spell
from course.engine.render.binding import bind, needs_of, skipped_modules
from course.engine.scene.building.materials import returned_share
from course.engine.scene.darkness import why_dark
from course.engine.scene.scene import Scene

MOST_OBJECTS = 20
"""Objects that are listed one by one."""


def summarize(scene: Scene) -> dict[str, dict[str, object]]:
    """Sections of labels and values; nothing is rendered."""
    description, settings = scene.loaded.description, scene.settings
    compiled, world = scene.compiled, scene.compiled.world
    integrator = bind(scene, settings).integrator
    needs = needs_of(scene, settings)
    frame = compiled.frame
    dimensions = {"pixel": "2 numbers a sample"}
    samples = f"{settings.samples} a pixel, {settings.sampler}"
    division = settings.subdivision
    if division is not None:
        dimensions = {}
        samples = (
            f"{settings.samples} through each corner of a pixel, and of its parts down to 1/{1 << division.depth}"
            f" where corners differ by more than {division.threshold:g}"
        )
    for light in world.lights:
        if light.width:
            dimensions[light.name] = f"{light.width} numbers a sample and bounce"
    kinds = Counter(light.__struct_config__.tag for light in description.lights)
    shapes = Counter(thing.__struct_config__.tag for thing in description.objects)
    skipped = {**skipped_modules(needs, description.integrator), **world.skipped_lights}
    return {
        "scene": {
            "title": scene.title,
            "picture": f"{settings.width} x {settings.height} pixels",
            "samples": samples,
            "bounces": integrator.max_depth,
        },
        "objects": {
            **{str(shape): number for shape, number in shapes.items()},
            "triangles": sum(compiled.triangles),
            **({"pieces": f"{compiled.pieces:,} triangles more"} if compiled.pieces else {}),
            "materials": len(description.materials),
            "center": "{:g} {:g} {:g}".format(*frame.center),
            "half extent": f"{frame.scale * frame.reach:g}",
        },
        "bounds": _bounds(scene),
        "lights": {str(kind): number for kind, number in kinds.items()},
        "sampled": dict(dimensions),
        "effects": {
            **{
                f"calls {need.function}": scene.loaded.document.where(need.asked_by)
                for need in needs
            },
            **{f"skips {name}": reason for name, reason in skipped.items()},
        },
        "hints": _hints(scene),
    }


def _bounds(scene: Scene) -> dict[str, object]:
    """Bounds of each object, in the units of the file, as a help to place another."""
    things, compiled = scene.loaded.description.objects, scene.compiled
    rows = []
    for number, thing in enumerate(things[:MOST_OBJECTS]):
        low, high = compiled.bounds[number]
        # What is left of a zero after a turn would hide it.
        noise = 1e-12 * max(np.abs(low).max(), np.abs(high).max())
        spans = [
            f"{axis} {a if abs(a) > noise else 0:g}..{b if abs(b) > noise else 0:g}"
            for axis, a, b in zip("xyz", low, high, strict=True)
        ]
        label = f"{number} {thing.name or thing.__struct_config__.tag}"
        rows.append((label, [thing.material, f"{compiled.triangles[number]:,} triangles", *spans]))
    widths = [max(map(len, column)) for column in zip(*(cells for _, cells in rows), strict=True)]
    listed: dict[str, object] = {
        label: "  ".join(f"{cell:<{width}}" for cell, width in zip(cells, widths, strict=True))
        for label, cells in rows
    }
    more = len(things) - len(rows)
    return listed | ({f"and {more:,} more": ""} if more else {})


def _hints(scene: Scene) -> dict[str, object]:
    """Warnings of settings that can be rendered, but are probably mistakes."""
    description, document = scene.loaded.description, scene.loaded.document
    hints: dict[str, object] = {}
    for name, material in description.materials.items():
        share = returned_share(material)
        if share.max() > 1.0 + 1e-9:
            path = ("materials", name)
            rest = "1 (reflected and refracted)" if material.dielectric else "color * diffuse"
            numbers = ", ".join(f"{channel:g}" for channel in share)
            hints[spell(path)] = (
                f"{document.where(path)}: returns more light than it gets: {rest} + mirror is [{numbers}]"
            )
    black = why_dark(scene)
    return hints | ({"lights": black} if black else {})
