"""A scene file, read and checked: YAML -> Document -> SceneDescription."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from course.errors import SceneError
from course.scene.consistency import check_consistency
from course.scene.description.scene import SceneDescription
from course.scene.description.transforms import STEP
from course.scene.document import Document
from course.scene.overriding import Overrides, override
from course.scene.yaml_tree import read_document


@dataclass(frozen=True)
class Loaded:
    """A checked scene file.

    Attributes
    ----------
    description : SceneDescription
        What the file says, with defaults filled in.
    document : Document
        The file's own values and their lines, for the errors of later stages.
    path : pathlib.Path
        Where the file lies; the paths in it are relative to its folder.
    """

    description: SceneDescription
    document: Document
    path: Path


def load_description(path: Path, overrides: Overrides | None = None) -> Loaded:
    """Read a scene file and check all that can be checked without its meshes.

    Parameters
    ----------
    path : pathlib.Path
        A YAML file in the scene format (see `course.scene.schema`).
    overrides : mapping from key path to value, optional
        What stands there instead of what the file says, such as
        ``{("lights", 0, "samples"): "ball"}``; checked like the rest (`course.scene.overriding`).

    Raises
    ------
    SceneError
        For the first mistake, in one line that names the file, the line, the key path, the value
        and what was expected.
    """
    path = Path(path)
    document = read_document(path)
    if overrides:
        document = override(document, overrides)
    description = _convert(document)
    check_consistency(description, document)
    return Loaded(description, document, path)


def _convert(document: Document) -> SceneDescription:
    try:
        return msgspec.convert(_with_tags(document.data), SceneDescription)
    except msgspec.ValidationError as error:
        # Imported here, for it is only needed to word a message.
        from course.scene.checking import find_mistake

        mistake = find_mistake(document)
        raise mistake or SceneError(f"{document.file}: {error}") from None


def _with_tags(data: dict[str, Any]) -> dict[str, Any]:
    """Add the tags that msgspec needs and the file doesn't hold.

    A transform step is told by its only key. And msgspec lets the tag of a union of one be left
    out, which would make files wrong as soon as there is a second kind.
    """
    tagged = dict(data)
    if isinstance(data.get("environment"), dict):
        tagged["environment"] = {"type": "", **data["environment"]}
    if isinstance(data.get("objects"), list):
        tagged["objects"] = [_with_tagged_steps(thing) for thing in data["objects"]]
    return tagged


def _with_tagged_steps(thing: Any) -> Any:
    if not (isinstance(thing, dict) and isinstance(thing.get("transform"), list)):
        return thing
    steps = [_tagged_step(step) if isinstance(step, dict) else step for step in thing["transform"]]
    return {**thing, "transform": steps}


def _tagged_step(step: dict[str, Any]) -> dict[str, Any]:
    return {**step, STEP: next(iter(step)) if len(step) == 1 else ""}
