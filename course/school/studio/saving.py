"""A view of the studio as YAML: what was changed, to copy, or a new file beside the scene with all of its comments."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from course.base.errors import CourseError, SceneError
from course.engine.formats.yaml.document import KeyPath, spell
from course.engine.formats.yaml.loading import load_description

if TYPE_CHECKING:
    from course.school.studio.studio import Studio

MOST_FILES = 1000


def written(value: Any) -> str:
    """A number, or a list of numbers, as YAML."""
    return json.dumps(value)


def yaml_of_view(studio: Studio) -> str:
    """Where the camera is, and the other values that were changed, as they belong into the scene file."""
    camera, values = studio.state()["camera"], dict(studio.values)
    eye, look_at = written(list(camera["eye"])), written(list(camera["look_at"]))
    others = [
        f"# {spell(path)}: {written(value)}"
        for path, value in values.items()
        if path != ("camera", "eye")
    ]
    return "\n".join(["camera:", f"  eye: {eye}", f"  look_at: {look_at}", *others]) + "\n"


def write_view(studio: Studio) -> tuple[bool, str]:
    """Write the scene with the changed values as a new file beside it; whether that was done, and what to say."""
    try:
        path = save_view(studio.scene, dict(studio.values))
    except (CourseError, OSError) as error:
        return False, str(error)
    return True, f"{path.name} was written"


def save_view(scene: Path, values: dict[KeyPath, Any]) -> Path:
    """Write a new file beside a scene: its text, with other values in their places and all else as it is.

    Raises
    ------
    SceneError
        The file's text can't be changed without changing more.
    """
    text = changed_text(scene.read_text(encoding="utf-8"), values)
    for number in range(1, MOST_FILES):
        path = scene.with_name(f"{scene.stem}-view-{number}{scene.suffix}")
        try:
            # Never over a file that is there.
            with path.open("x", encoding="utf-8") as file:
                file.write(text)
        except FileExistsError:
            continue
        try:
            same = load_description(path).description == load_description(scene, values).description
        except CourseError:
            same = False
        if not same:
            path.unlink()
            raise SceneError(f"{scene}: these values can't be written into its text; copy them")
        return path
    raise SceneError(f"{scene}: there are {MOST_FILES} views of it already")


def changed_text(text: str, values: dict[KeyPath, Any]) -> str:
    """YAML with other values at some key paths; a key that isn't there is added to its map."""
    root = yaml.compose(text, Loader=yaml.SafeLoader)
    edits: list[tuple[int, int, str]] = []
    for path, value in values.items():
        node: Any = root
        for depth, key in enumerate(path):
            below = _below(node, key)
            if below is None:
                edits.append(_added(node, path[depth:], value))
                break
            node = below
        else:
            first, last = node.start_mark.index, node.end_mark.index
            if "#" in text[first:last]:
                raise SceneError(f"{spell(path)} has a comment in it; copy the value instead")
            edits.append((first, last, written(value)))
    for first, last, new in sorted(edits, reverse=True):
        text = text[:first] + new + text[last:]
    return text


def _below(node: Any, key: Any) -> Any:
    if isinstance(node, yaml.MappingNode):
        return next((value for name, value in node.value if name.value == key), None)
    if isinstance(node, yaml.SequenceNode) and isinstance(key, int) and key < len(node.value):
        return node.value[key]
    return None


def _added(node: Any, path: KeyPath, value: Any) -> tuple[int, int, str]:
    """The edit that adds a key, or a map of a key, to a map of the file."""
    for key in reversed(path[1:]):
        value = {key: value}
    new = f"{path[0]}: {written(value)}"
    if not isinstance(node, yaml.MappingNode) or not node.value:
        raise SceneError(f"{spell(path)} has no place in the file; copy the value instead")
    first = node.value[0][0].start_mark
    if node.flow_style:
        return first.index, first.index, f"{new}, "
    return first.index, first.index, f"{new}\n{' ' * first.column}"
