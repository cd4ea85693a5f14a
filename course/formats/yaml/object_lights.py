"""Objects that are lights: checked against each other, and told apart from others of the same material."""

from __future__ import annotations

from dataclasses import dataclass

from course.formats.yaml.description import ObjectLight, SceneDescription, rgb
from course.formats.yaml.document import Document, suggest


def check_object_lights(description: SceneDescription, document: Document) -> None:
    """Check that every light of type object names one object of its own, which emits.

    Raises SceneError for the first that doesn't; names the key to change.
    """
    names = [thing.name for thing in description.objects if thing.name]
    lit: dict[str, int] = {}
    for index, light in enumerate(description.lights):
        if not isinstance(light, ObjectLight):
            continue
        path = ("lights", index, "object")
        if light.object not in names:
            hint = suggest(light.object, dict.fromkeys(names))
            raise document.unexpected(path, f"the name of one of the objects; {hint}")
        if light.object in lit:
            raise document.unexpected(
                path,
                f"another object than that of lights[{lit[light.object]}]: one light is enough",
            )
        lit[light.object] = index
        first, *others = (n for n, o in enumerate(description.objects) if o.name == light.object)
        if others:
            raise document.unexpected(
                ("objects", others[0], "name"),
                f"another name than that of objects[{first}], for lights[{index}] means one of them",
            )
        material = description.objects[first].material
        if not rgb(description.materials[material].emission).any():
            raise document.unexpected(
                path,
                f'an object that shines; give its material an emission, such as "{material}: {{emission: 5}}"',
            )


def lit_objects(description: SceneDescription) -> dict[int, int]:
    """For each light that is an object its number, and that of the object."""
    numbers = {thing.name: number for number, thing in enumerate(description.objects)}
    return {
        index: numbers[light.object]
        for index, light in enumerate(description.lights)
        if isinstance(light, ObjectLight)
    }


@dataclass(frozen=True)
class Columns:
    """Columns of the material table: one for each material that objects have, then one for each object that is a light.

    Attributes
    ----------
    names : of their materials
    of_objects : the column of each object
    of_lights : the column of each light that is an object, by the number of the light
    """

    names: tuple[str, ...]
    of_objects: tuple[int, ...]
    of_lights: dict[int, int]


def material_columns(description: SceneDescription) -> Columns:
    """Which columns there are; materials that no object has are as good as not there."""
    lit = lit_objects(description)
    columns = dict.fromkeys(lit.values(), -1)
    names: list[str] = []
    for number, thing in enumerate(description.objects):
        if number in columns:
            continue
        if thing.material not in names:
            names.append(thing.material)
        columns[number] = names.index(thing.material)
    for number in lit.values():
        columns[number] = len(names)
        names.append(description.objects[number].material)
    return Columns(
        tuple(names),
        tuple(columns[number] for number in range(len(description.objects))),
        {light: columns[number] for light, number in lit.items()},
    )
