"""METU scene files, XML or JSON, as one and the same tree of elements.

In JSON an attribute's name has a `_` in front, the text of an element that has attributes too is `_data`, elements of
one name make a list, and everything stands under `Scene`.
"""

import json
import re
from pathlib import Path
from typing import Any, Final
from xml.parsers import expat

from course.base.errors import SceneError
from course.base.inputs import LARGEST_DATA, InputLimit, read_input, shown
from course.engine.formats.metu.element import MetuElement
from course.engine.formats.metu.suffixes import SUFFIXES, is_metu
from course.engine.formats.yaml.document import show

ROOT: Final = "Scene"
DEEPEST: Final = 32
UTF_16: Final = (b"\xff\xfe", b"\xfe\xff")
"""Marks at the beginning of a file by which XML's other encoding is known."""


def read_elements(path: Path) -> MetuElement:
    """Read a file as the element `Scene`.

    Raises SceneError for a file that is missing, unreadable, too large or not what its suffix says, for another root
    than Scene, and for XML with a document type, whose entities could grow beyond all bounds.
    """
    file = shown(path)
    if not is_metu(path):
        raise SceneError(
            f"{file}: expected a METU scene, a file that ends in {' or '.join(SUFFIXES)}"
        )
    data = read_input(path, "scene file", InputLimit(LARGEST_DATA), SceneError)
    root = _json(data, file) if path.suffix.lower() == ".json" else _xml(data, file)
    _number(root)
    return root


class _XmlReader:
    """Builds the tree from expat's events; no external entity is ever followed."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.root: MetuElement | None = None
        self._open: list[tuple[MetuElement, list[str]]] = []
        self._parser = expat.ParserCreate()
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._characters
        self._parser.StartDoctypeDeclHandler = self._doctype

    def read(self, data: bytes) -> MetuElement:
        try:
            self._parser.Parse(data, True)
        except expat.ExpatError as error:
            reason = expat.ErrorString(error.code) + self._encoding(data)
            raise SceneError(f"{self.file}:{error.lineno}: not valid XML: {reason}") from None
        except (LookupError, ValueError) as error:  # of the encoding that its first line names
            raise SceneError(
                f"{self.file}: XML that can't be read: {error}: save it as UTF-8"
            ) from None
        assert self.root is not None
        return self.root

    def _encoding(self, data: bytes) -> str:
        """Expat calls bytes that aren't UTF-8 an invalid token, whatever encoding they are in."""
        # An encoding that the first line names has been followed.
        if re.search(rb"encoding\s*=", data[:200].partition(b"?>")[0]) or data[:2] in UTF_16:
            return ""
        try:
            data.decode("utf-8")
        except UnicodeDecodeError as error:
            return (
                f"; byte {error.start} is not UTF-8: save the file as UTF-8, or begin it with the encoding that it"
                ' has, such as <?xml version="1.0" encoding="ISO-8859-1"?>'
            )
        return ""

    def _where(self) -> str:
        return f"{self.file}:{self._parser.CurrentLineNumber}"

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = MetuElement(tag, tag, self._where(), attributes)
        if self._open:
            self._open[-1][0].children.append(element)
        elif tag != ROOT:
            raise SceneError(f"{self._where()}: the root is {show(tag)}: expected {ROOT}")
        else:
            self.root = element
        self._open.append((element, []))
        if len(self._open) > DEEPEST:
            raise SceneError(f"{self._where()}: nested more than {DEEPEST} levels deep")

    def _end(self, _tag: str) -> None:
        element, texts = self._open.pop()
        element.text = "".join(texts)

    def _characters(self, text: str) -> None:
        self._open[-1][1].append(text)

    def _doctype(self, *_: object) -> None:
        raise SceneError(
            f"{self._where()}: has a document type (<!DOCTYPE ...>), which a scene doesn't need: remove it"
        )


def _xml(data: bytes, file: str) -> MetuElement:
    return _XmlReader(file).read(data)


def _json(data: bytes, file: str) -> MetuElement:
    try:
        content = json.loads(data, object_pairs_hook=lambda pairs: _map(pairs, file))
    except json.JSONDecodeError as error:
        raise SceneError(f"{file}:{error.lineno}: not valid JSON: {error.msg}") from None
    except UnicodeDecodeError as error:
        raise SceneError(f"{file}: not UTF-8 text: byte {error.start}") from None
    except (RecursionError, ValueError) as error:
        reason = "nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise SceneError(f"{file}: not JSON that can be read: {reason}") from None
    if not (isinstance(content, dict) and isinstance(content.get(ROOT), dict)):
        raise SceneError(f"{file}: expected a map with the key {ROOT}, which holds the scene")
    others = [key for key in content if key != ROOT]
    root = _from_json(ROOT, content[ROOT], file, 1)
    root.children += [MetuElement(key, key, file) for key in others]
    return root


def _map(pairs: list[tuple[str, Any]], file: str) -> dict[str, Any]:
    """A map of JSON, which would keep only the last of several values of one key; SceneError for those."""
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise SceneError(
                f"{file}: {show(key)} is given twice in one map, which counts only once:"
                " expected a list of both"
            )
        found[key] = value
    return found


def _from_json(tag: str, value: Any, file: str, depth: int) -> MetuElement:
    if depth > DEEPEST:
        raise SceneError(f"{file}: {show(tag)}: nested more than {DEEPEST} levels deep")
    element = MetuElement(tag, tag, file, plain=not isinstance(value, dict))
    if not isinstance(value, dict):
        element.text = _text(value)
        return element
    for key, item in value.items():
        if key == "_data":
            element.text = _text(item)
        elif key.startswith("_"):
            element.attributes[key[1:]] = _text(item)
        else:
            items = item if isinstance(item, list) and not _all_numbers(item) else [item]
            element.children += [_from_json(key, each, file, depth + 1) for each in items]
    return element


def _text(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return " ".join(map(_text, value))
    return str(value)


def _all_numbers(items: list[Any]) -> bool:
    return bool(items) and all(
        isinstance(item, int | float) and not isinstance(item, bool) for item in items
    )


def _number(element: MetuElement) -> None:
    """Give each element below this one its path; those of one name are counted from 1."""
    total: dict[str, int] = {}
    for child in element.children:
        total[child.tag] = total.get(child.tag, 0) + 1
    count: dict[str, int] = {}
    for child in element.children:
        count[child.tag] = count.get(child.tag, 0) + 1
        tag = child.tag if re.fullmatch(r"[\w.:-]{1,60}", child.tag) else show(child.tag)
        index = f"[{count[child.tag]}]" if total[child.tag] > 1 else ""
        child.path = f"{element.path}/{tag}{index}"
        _number(child)
