"""A scene file, read and checked: YAML -> Document -> SceneDescription."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from course.scene.checking import convert
from course.scene.consistency import check_consistency
from course.scene.description.scene import SceneDescription
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
    description = convert(document, SceneDescription)
    check_consistency(description, document)
    return Loaded(description, document, path)
