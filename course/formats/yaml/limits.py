"""Bounds of the files that a scene names."""

from __future__ import annotations

from course.formats.yaml.description.limits import LimitsDescription
from course.formats.yaml.document import Document
from course.inputs import Bound


def bytes_of_files(document: Document) -> Bound:
    """The most bytes of a mesh or picture that a checked scene allows."""
    return _bound(document, "bytes")


def pixels_of_pictures(document: Document) -> Bound:
    """The most pixels of a picture that a checked scene allows."""
    return _bound(document, "pixels")


def _bound(document: Document, key: str) -> Bound:
    given = document.data.get("limits", {})
    return Bound(given.get(key, getattr(LimitsDescription(), key)), f"limits.{key}")
