"""Mesh objects whose faces have materials by the file's names: an object for each material."""

import warnings
from pathlib import Path

from msgspec.structs import replace

from course.base.errors import CourseWarning, GeometryError, SceneError
from course.base.inputs import InputLimit
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.document import Document, show
from course.engine.formats.yaml.suggestions import suggest

MOST_NAMES = 5
"""That a message lists."""


def parted(
    scene: d.SceneDescription, document: Document, folder: Path, bound: InputLimit
) -> tuple[d.SceneDescription, Document]:
    """Return the scene with an object for each material of a mesh, those after the first one behind all others.

    A `CourseWarning` tells the names of the file that the scene doesn't give a material.
    Raises SceneError: the file can't be read, or has no such name.
    ``bound``: the most bytes of a mesh file
    """
    objects, copies = list(scene.objects), list[int]()
    for number, thing in enumerate(scene.objects):
        if not (isinstance(thing, d.MeshFile) and thing.materials):
            continue
        names = _names(thing, number, document, folder, bound)
        for name in thing.materials:
            if name not in names:
                raise document.error(
                    ("objects", number, "materials", name),
                    f"no face of {thing.file} has a material of that name; {suggest(name, names)}",
                )
        left = [name for name in names if name not in thing.materials]
        if left:
            warnings.warn(
                f"{document.where(('objects', number, 'materials'))}: {listed(left)} of {thing.file} aren't named, and"
                f" have material {show(thing.material)}",
                CourseWarning,
                stacklevel=2,
            )
        of: dict[str, list[str]] = {thing.material: left} if left else {}
        for name, material in thing.materials.items():
            of.setdefault(material, []).append(name)
        parts = [
            replace(thing, material=material, only=tuple(some), materials={})
            for material, some in of.items()
        ]
        objects[number] = parts[0]
        for part in parts[1:]:
            objects.append(replace(part, name=thing.name and f"{thing.name}: {part.material}"))
            copies.append(number)
    if not copies and objects == list(scene.objects):
        return scene, document
    return replace(scene, objects=tuple(objects)), _with_copies(document, copies)


def listed(names: list[str]) -> str:
    """The faces of some of a file's materials, as a message calls them."""
    some = ", ".join(show(name) if name else "those without a name" for name in names[:MOST_NAMES])
    more = f" and {len(names) - MOST_NAMES:,} more" if len(names) > MOST_NAMES else ""
    return f"the faces of {some}{more}"


def _names(
    thing: d.MeshFile, number: int, document: Document, folder: Path, bound: InputLimit
) -> list[str]:
    """Names of materials that faces have, in the order of the file."""
    from course.engine.formats.meshes.files import read_named_mesh

    try:
        # What there is to tell of the file is told when the object is made.
        with warnings.catch_warnings(action="ignore"):
            found = read_named_mesh(folder / thing.file, thing.normals, bound)
    except GeometryError as error:
        where = document.where(("objects", number, "file"))
        raise SceneError(f"{where}: objects[{number}]: {error}") from error
    return [name for name in found.names if thing.only is None or name in thing.only]


def _with_copies(document: Document, copies: list[int]) -> Document:
    """The document with some of its objects once more behind the others, in the same lines."""
    objects, data = document.data["objects"], dict(document.data)
    data["objects"] = [*objects, *(objects[k] for k in copies)]
    lines = dict(document.lines)
    lines[id(data)] = lines[id(document.data)]
    at = lines[id(objects)]
    assert isinstance(at, list)
    lines[id(data["objects"])] = [*at, *(at[k] for k in copies)]
    return Document(document.file, data, lines)
