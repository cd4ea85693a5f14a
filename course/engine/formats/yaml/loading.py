"""A scene file, read and checked: YAML -> Document -> SceneDescription; and pictures it names, within its bounds."""

from dataclasses import dataclass
from pathlib import Path

from course.base.errors import SceneError
from course.base.inputs import InputLimit
from course.engine.core.types import Floats32
from course.engine.formats.pictures.reading import read_picture
from course.engine.formats.yaml.checking import convert
from course.engine.formats.yaml.consistency import check_consistency
from course.engine.formats.yaml.description import LimitsDescription, SceneDescription
from course.engine.formats.yaml.document import Document, KeyPath
from course.engine.formats.yaml.overriding import Overrides, override
from course.engine.formats.yaml.parting import parted
from course.engine.formats.yaml.tree import read_document


@dataclass(frozen=True)
class Loaded:
    """A checked scene file.

    Attributes
    ----------
    description : what the file says, with defaults filled in
    document : the file's own values and their lines, for the errors of later stages
    path : where the file lies; the paths in it are relative to its folder
    """

    description: SceneDescription
    document: Document
    path: Path


def load_description(path: Path, overrides: Overrides | None = None) -> Loaded:
    """Read a scene file and check all that can be checked without its meshes, but for names of their materials.

    Raises SceneError for the first mistake, in one line that names the file, the line, the key path, the value and what
    was expected.

    Parameters
    ----------
    path : a YAML file in the scene format (see `course.engine.formats.yaml.schema`)
    overrides : mapping from key path to value, optional
        What stands there instead of what the file says, such as
        ``{("lights", 0, "samples"): "ball"}``; checked like the rest (`course.engine.formats.yaml.overriding`).
    """
    path = Path(path)
    document = read_document(path)
    if overrides:
        document = override(document, overrides)
    description = convert(document, SceneDescription)
    check_consistency(description, document)
    bound = bytes_of_files(document)
    return Loaded(*parted(description, document, path.parent, bound), path)


def bytes_of_files(document: Document) -> InputLimit:
    """The most bytes of a mesh or picture that a checked scene allows."""
    return _bound(document, "bytes")


def read_named_picture(
    file: str, path: KeyPath, loaded: Loaded, codes: bool = False, layer: str | None = None
) -> Floats32:
    """A picture that a scene names as linear RGB, or codes, (H, W, 3); SceneError by the key that names it."""
    document = loaded.document
    try:
        return read_picture(
            loaded.path.parent / file,
            bytes_of_files(document),
            _bound(document, "pixels"),
            codes,
            layer,
        )
    except SceneError as error:
        raise document.error(path, str(error)) from error


def _bound(document: Document, key: str) -> InputLimit:
    given = document.data.get("limits", {})
    return InputLimit(given.get(key, getattr(LimitsDescription(), key)), f"limits.{key}")
