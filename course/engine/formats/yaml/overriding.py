"""A document with some of its values replaced: variants of a scene without files of their own."""

from collections.abc import Mapping
from typing import Any

from course.engine.formats.yaml.document import Document, Key, KeyPath, Lines
from course.engine.formats.yaml.suggestions import suggest

Overrides = Mapping[KeyPath, Any]
"""Key path -> the value that stands there instead, as YAML would give it: maps, lists, texts, numbers."""


def override(document: Document, overrides: Overrides) -> Document:
    """A copy of a document with other values at some key paths.

    Raises SceneError: a path leads nowhere in this document, or one override lies within another.
    Values that were replaced stand on the line of the old ones, new ones on that of the map that
    holds them.

    Parameters
    ----------
    document : of the scene file; it stays as it is
    overrides : the last key of a path may be new where it is a map's; all keys before it are there
    """
    for path in overrides:
        _check_path(path, document)
        for length in range(len(path)):
            if path[:length] in overrides:
                raise document.error(path, "is overridden together with what it is in")
    lines: dict[int, Lines] = {}
    data = _overridden(document.data, (), overrides, document.lines, lines)
    return Document(document.file, data, lines)


def _check_path(path: KeyPath, document: Document) -> None:
    value: Any = document.data
    for depth, key in enumerate(path):
        last = depth == len(path) - 1
        known = list(value) if isinstance(value, dict) else []
        if isinstance(value, dict) and isinstance(key, str) and (key in value or last):
            value = value.get(key)
        elif isinstance(value, list) and isinstance(key, int) and 0 <= key < len(value):
            value = value[key]
        else:
            hint = suggest(key, known) if known else "there is no such item"
            raise document.error(path[: depth + 1], f"can't be overridden: {hint}")
    if not path:
        raise document.error(path, "can't be overridden as a whole")


def _overridden(
    value: Any, path: KeyPath, overrides: Overrides, old: Mapping[int, Lines], new: dict[int, Lines]
) -> Any:
    """The value at a path, copied; `new` gets the lines of the copies, by their ids, as `old` has them."""
    if path in overrides:
        return overrides[path]
    if not isinstance(value, dict | list):
        return value
    items: list[tuple[Key, Any]] = list(
        value.items() if isinstance(value, dict) else enumerate(value)
    )
    if isinstance(value, dict):
        added = (p[-1] for p in overrides if p[:-1] == path and p[-1] not in value)
        items += [(key, None) for key in added]
    changed = [(key, _overridden(item, (*path, key), overrides, old, new)) for key, item in items]
    copy: Any = dict(changed) if isinstance(value, dict) else [item for _, item in changed]
    if id(value) in old:
        new[id(copy)] = old[id(value)]
    return copy
