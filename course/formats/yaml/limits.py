"""The files that a scene names, within the bounds that it sets."""

from __future__ import annotations

from course.core.types import Floats32
from course.errors import SceneError
from course.formats.pictures.reading import read_picture
from course.formats.yaml.description import LimitsDescription
from course.formats.yaml.document import Document, KeyPath
from course.formats.yaml.loading import Loaded
from course.inputs import Bound


def bytes_of_files(document: Document) -> Bound:
    """The most bytes of a mesh or picture that a checked scene allows."""
    return _bound(document, "bytes")


def read_named_picture(file: str, path: KeyPath, loaded: Loaded) -> Floats32:
    """A picture that a scene names as linear RGB, (H, W, 3); SceneError by the key that names it."""
    document = loaded.document
    try:
        return read_picture(
            loaded.path.parent / file, bytes_of_files(document), _bound(document, "pixels")
        )
    except SceneError as error:
        raise document.error(path, str(error)) from error


def _bound(document: Document, key: str) -> Bound:
    given = document.data.get("limits", {})
    return Bound(given.get(key, getattr(LimitsDescription(), key)), f"limits.{key}")
