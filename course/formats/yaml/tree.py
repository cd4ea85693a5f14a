"""From YAML text to a Document, for text that nobody has reason to trust.

PyYAML only splits the text into events, from which `tree_builder` makes the tree. PyYAML's own
loaders resolve words by YAML 1.1, let a later key silently replace an earlier one, forget line
numbers, recurse once for each level of nesting, and follow aliases and tags wherever they lead.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

from course.errors import SceneError
from course.formats.yaml.document import Document, show
from course.formats.yaml.suggestions import suggest
from course.formats.yaml.tree_builder import TreeBuilder
from course.inputs import LARGEST_SCENE, Bound, read_input, shown

_NOT_TEXT = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_SCENE_KEYS = "keys such as camera, materials, lights and objects"
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_document(path: Path, what: str = "scene") -> Document:
    """Read a YAML file; `what` is what it describes, for messages.

    Raises
    ------
    SceneError
        For a file that is missing, unreadable, too large, not UTF-8 or not YAML, and for YAML that
        repeats a key, carries tags, holds numbers that are not finite, or grows beyond bounds.
    """
    return parse_document(_read(path, what), shown(path), what)


def parse_document(content: bytes, file: str, what: str = "scene") -> Document:
    """Parse the content of a YAML file; `file` is its name in messages. Raises as read_document."""
    text = _decode(content, file)
    builder = TreeBuilder(file)
    try:
        for event in yaml.parse(text, Loader=_Loader):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        raise _not_yaml(error, text, file) from None
    except yaml.YAMLError as error:
        raise SceneError(f"{file}: not valid YAML: {' '.join(str(error).split())}") from None
    if builder.root is None:
        raise SceneError(f"{file}: the file is empty: expected a {what}")
    if not isinstance(builder.root, dict):
        raise SceneError(
            f"{file}:{builder.root_line}: the file is {_kind(builder.root)}: expected a map with "
            + (_SCENE_KEYS if what == "scene" else f"the keys of a {what}")
        )
    return Document(file, builder.root, builder.lines)


def _read(path: Path, what: str) -> bytes:
    try:
        return read_input(path, f"{what} file", Bound(LARGEST_SCENE), SceneError)
    except SceneError as error:
        if isinstance(error.__cause__, FileNotFoundError):
            raise SceneError(f"{error}{_near(path)}") from None
        raise


def _near(path: Path) -> str:
    try:
        names = [entry.name for entry in path.parent.iterdir() if entry.suffix in {".yaml", ".yml"}]
    except OSError:
        return "" if path.parent.is_dir() else "; its folder is missing too"
    hint = suggest(path.name, sorted(names))
    return f"; {hint}" if hint.startswith("did") else ""


def _decode(content: bytes, file: str) -> str:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise SceneError(
            f"{file}:{line}: not UTF-8 text: byte {error.start} is 0x{content[error.start]:02x}"
        ) from None
    if found := _NOT_TEXT.search(text):
        line = text.count("\n", 0, found.start()) + 1
        raise SceneError(f"{file}:{line}: not text: character U+{ord(found.group()):04X}")
    return text


def _not_yaml(error: yaml.MarkedYAMLError, text: str, file: str) -> SceneError:
    mark = error.problem_mark or error.context_mark
    line = mark.line + 1 if mark else 1
    message = f"{file}:{line}: not valid YAML: {error.problem or error.context}"
    if error.problem and error.context and error.context_mark:
        message += f", {error.context} that starts on line {error.context_mark.line + 1}"
    lines = text.splitlines()
    if line <= len(lines) and "\t" in lines[line - 1]:
        message += " (YAML is indented with spaces, not tabs)"
    return SceneError(message)


def _kind(value: object) -> str:
    return "a list" if isinstance(value, list) else f"just {show(value)}"
