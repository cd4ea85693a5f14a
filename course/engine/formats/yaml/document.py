"""A scene file as plain data that still knows the line of each value."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from course.base.errors import SceneError

Key: TypeAlias = str | int
KeyPath: TypeAlias = tuple[Key, ...]
Lines: TypeAlias = dict[str, int] | list[int]

PLAIN_KEY = re.compile(r"[^\W\d][\w-]*")
LONGEST = 60


@dataclass(frozen=True)
class Document:
    """The content of one scene file.

    Attributes
    ----------
    file : name of the file, as the user gave it
    data : Maps, lists, texts, numbers, booleans and None. Aliases share their value.
    lines : mapping from int to dict or list
        For the id of each map or list in `data`, the line of each of its keys or items, from 1.
    """

    file: str
    data: dict[str, Any]
    lines: Mapping[int, Lines]

    def line(self, path: KeyPath) -> int:
        """Line of a key path, counted from 1; of its nearest parent where it isn't in the file."""
        line, value = 1, self.data
        for key in path:
            lines: Any = self.lines.get(id(value))
            try:
                line, value = lines[key], value[key]  # type: ignore[index]
            except (TypeError, KeyError, IndexError):
                break
        return line

    def where(self, path: KeyPath) -> str:
        """`file:line` of a key path, or of its nearest parent in the file."""
        return f"{self.file}:{self.line(path)}"

    def value(self, path: KeyPath) -> Any:
        """Value at a key path; raises LookupError where there is none."""
        value: Any = self.data
        for key in path:
            value = value[key]
        return value

    def error(self, path: KeyPath, message: str) -> SceneError:
        """Error about a key path: `box.yaml:7: camera.look_att: MESSAGE`."""
        return SceneError(f"{self.where(path)}: {spell(path)}: {message}")

    def unexpected(self, path: KeyPath, expected: str) -> SceneError:
        """Error about a value: `box.yaml:12: objects[2].radius is -1: expected EXPECTED`.

        A path that the file leaves out, so that a default holds, is named without a value.
        """
        try:
            value = show(self.value(path))
        except (LookupError, TypeError):
            return self.error(path, f"expected {expected}")
        return SceneError(f"{self.where(path)}: {spell(path)} is {value}: expected {expected}")


@dataclass(frozen=True)
class Place:
    """A map or a list of a document, whose values are checked; the whole document where no path is given."""

    document: Document
    path: KeyPath = ()

    def at(self, *keys: Key) -> "Place":
        """The value at these keys."""
        return Place(self.document, (*self.path, *keys))

    def error(self, message: str) -> SceneError:
        """Error about all of it; see ``Document.error``."""
        return self.document.error(self.path, message)

    def check(self, holds: bool | np.bool, key: Key, expected: str) -> None:
        """Raise SceneError about the value of a key where something doesn't hold; see ``Document.unexpected``."""
        if not holds:
            raise self.document.unexpected((*self.path, key), expected)


def spell(path: KeyPath) -> str:
    """Write a key path as in messages: `objects[2].transform[0].rotate`."""
    text = ""
    for key in path:
        if isinstance(key, int):
            text += f"[{key}]"
        elif PLAIN_KEY.fullmatch(key) and len(key) <= LONGEST:
            text += f".{key}" if text else key
        else:
            text += f"[{show(key)}]"
    return text or "the scene"


def show(value: object) -> str:
    """Write a value as in the file, on one line and cut where it is long."""
    if isinstance(value, list):
        items = ["[...]" if isinstance(item, list) else show(item) for item in value[:4]]
        return _cut(f"[{', '.join(items + ['...'] * (len(value) > 4))}]")
    if isinstance(value, dict):
        return "a map" if value else "an empty map"
    if isinstance(value, str):
        text = value[: LONGEST + 1]
        if not text.isprintable():
            text = text.encode("unicode_escape").decode("ascii")
        return f'"{_cut(text)}"'
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    return _cut(str(value))


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."
