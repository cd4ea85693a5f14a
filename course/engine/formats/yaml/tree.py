"""From YAML text to a Document, for text that nobody has reason to trust.

PyYAML only splits the text into events, from which `TreeBuilder` makes the tree, within bounds. PyYAML's own
loaders resolve words by YAML 1.1, let a later key silently replace an earlier one, forget line
numbers, recurse once for each level of nesting, and follow aliases and tags wherever they lead.
Aliases share their value here, so that the tree grows with the file and not with its expansion; how
large it would be with every alias written out is only counted.

Unquoted words have the meaning of the core schema of YAML 1.2, with numbers kept in bounds. Unlike in YAML 1.1, which
PyYAML resolves, `1e-3` is a number and `yes`, `no`, `on`, `off` are texts.
"""

import math
import re
from contextlib import suppress
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Final

import yaml

from course.base.errors import SceneError
from course.base.inputs import LARGEST_SCENE, InputLimit, read_input, shown, text_of
from course.engine.formats.yaml.document import LONGEST, Document, Key, Lines, show, spell
from course.engine.functions.effects import CHECKOUT, begin

# The square of a number within these is finite and not zero in float64.
LARGEST = 1e150
SMALLEST = 1e-150

_NULL = {"", "~", "null", "Null", "NULL"}
_BOOLEAN = {
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_INTEGER = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", re.ASCII)
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)", re.ASCII)
_MOST_DIGITS = 160


def resolve(word: str) -> str | int | float | bool | None:
    """Give an unquoted word its value.

    Raises ValueError for a number that is infinite, not a number, or larger or smaller than float64 can square; the
    message says what was expected.
    ``word``: a plain scalar, without quotes around it.

    YAML 1.2.2, section 10.3.2, tag resolution of the core schema.
    """
    if word in _NULL:
        return None
    if word in _BOOLEAN:
        return _BOOLEAN[word]
    if _NOT_FINITE.fullmatch(word):
        raise ValueError("a finite number")
    if _INTEGER.fullmatch(word):
        return _integer(word)
    if _FLOAT.fullmatch(word):
        return _float(word)
    return word


def _integer(word: str) -> int:
    # int() takes time quadratic in the number of digits, and refuses more than some thousands.
    sign, base = (-1 if word[0] == "-" else 1), {"0o": 8, "0x": 16}.get(word[:2], 10)
    digits = (word[2:] if base != 10 else word.lstrip("+-")).lstrip("0") or "0"
    number = sign * int(digits, base) if len(digits) <= _MOST_DIGITS else math.inf
    if abs(number) > LARGEST:
        raise ValueError(_within_bounds())
    return int(number)


def _float(word: str) -> float:
    number = float(word)
    # A zero that is written with another digit than 0 has underflowed.
    written_as_zero = re.search("[1-9]", re.split("[eE]", word)[0]) is None
    if not (written_as_zero or SMALLEST <= abs(number) <= LARGEST) or math.isinf(number):
        raise ValueError(_within_bounds())
    return number


def _within_bounds() -> str:
    return "0 or a number from 1e-150 to 1e150 in size"


MOST_VALUES: Final = 2_000_000  # counted with every alias written out; 100,000 lamps have 1,100,000
DEEPEST: Final = 64

_TOO_DEEP = f"nested more than {DEEPEST} levels deep: too deep for a scene"

_MERGE = object()


@dataclass(frozen=True)
class _Built:
    """A finished value; size and height count it with every alias written out."""

    value: Any
    size: int = 1
    height: int = 0


@dataclass
class _Open:
    """A map or list whose end has not been read yet."""

    value: Any
    lines: Lines
    line: int
    anchor: str | None
    size: int = 1
    height: int = 1
    key: Any = None
    merged: list[dict[str, Any]] = field(default_factory=list)

    def position(self) -> Key | None:
        """Key of the value that comes next."""
        return len(self.value) if isinstance(self.value, list) else self.key


class TreeBuilder:
    """Takes the events of one YAML stream; holds the tree when all are taken.

    Attributes
    ----------
    root : the whole tree; None for an empty file
    root_line : line on which it starts
    lines : for the id of each map or list, the lines of its keys or items (see `Document`)
    """

    def __init__(self, file: str) -> None:
        self.file = file
        self.root: Any = None
        self.root_line = 1
        self.lines: dict[int, Lines] = {}
        self._documents = 0
        self._values = 0
        self._open: list[_Open] = []
        self._anchors: dict[str, _Built] = {}

    def take(self, event: Any) -> None:
        """Add what one event of `yaml.parse` says.

        Raises SceneError for a repeated key, a tag, a number out of bounds, an alias without anchor, a second document,
        or too many values.
        """
        line = event.start_mark.line + 1
        if (tag := getattr(event, "tag", None)) is not None:
            name = show(tag.replace("tag:yaml.org,2002:", "!!"))[1:-1]
            raise self._error(line, f"tag {name} is refused: a scene file holds plain data only")
        match event:
            case yaml.DocumentStartEvent():
                self._documents += 1
                if self._documents > 1:
                    raise self._error(line, "a second document starts: expected one scene a file")
            case yaml.ScalarEvent():
                self._add(self._scalar(event, line), line, event.anchor)
            case yaml.AliasEvent():
                self._add(self._alias(str(event.anchor), line), line, None)
            case yaml.MappingStartEvent():
                self._start(_Open({}, {}, line, event.anchor))
            case yaml.SequenceStartEvent():
                self._start(_Open([], [], line, event.anchor))
            case yaml.MappingEndEvent() | yaml.SequenceEndEvent():
                self._end()

    def _scalar(self, event: yaml.ScalarEvent, line: int) -> _Built:
        if not event.implicit[0]:
            return _Built(event.value)
        if self._expects_key() and event.value == "<<":
            return _Built(_MERGE)
        try:
            return _Built(resolve(event.value))
        except ValueError as error:
            path = spell(self._path())
            shown = show(event.value)[1:-1]
            raise self._error(line, f"{path} is {shown}: expected {error}") from None

    def _alias(self, name: str, line: int) -> _Built:
        if any(frame.anchor == name for frame in self._open):
            raise self._error(line, f"alias *{show(name)[1:-1]} stands inside its own anchor")
        if name not in self._anchors:
            raise self._error(line, f"alias *{show(name)[1:-1]} has no anchor before it")
        return self._anchors[name]

    def _start(self, frame: _Open) -> None:
        if self._expects_key():
            raise self._error(frame.line, f"a key of {self._place()} is {_container(frame.value)}")
        self._check_depth(1, frame.line)
        self._open.append(frame)

    def _end(self) -> None:
        frame = self._open.pop()
        for source in frame.merged:
            lines: Any = self.lines[id(source)]
            for key, value in source.items():
                if key not in frame.value:
                    frame.value[key] = value
                    frame.lines[key] = lines[key]  # type: ignore[call-overload]
        self.lines[id(frame.value)] = frame.lines
        built = _Built(frame.value, frame.size, frame.height)
        self._add(built, frame.line, frame.anchor)

    def _add(self, built: _Built, line: int, anchor: str | None) -> None:
        self._count(line)
        self._check_depth(built.height, line)
        if anchor is not None:
            self._anchors[anchor] = built
        if not self._open:
            self.root, self.root_line = built.value, line
            return
        frame = self._open[-1]
        if self._expects_key():
            self._set_key(frame, built.value, line)
            return
        frame.size += built.size
        frame.height = max(frame.height, built.height + 1)
        if frame.size > MOST_VALUES:
            raise self._too_many(line)
        if isinstance(frame.value, list):
            frame.value.append(built.value)
            frame.lines.append(line)  # type: ignore[union-attr]
            return
        if frame.key is _MERGE:
            frame.merged += self._sources(built.value, line)
        else:
            frame.value[frame.key] = built.value
        frame.key = None

    def _set_key(self, frame: _Open, key: object, line: int) -> None:
        if key is not _MERGE and not isinstance(key, str):
            raise self._error(
                line, f"a key of {self._place()} is {show(key)}: expected text; put it in quotes"
            )
        name: Any = "<<" if key is _MERGE else key
        lines: Any = frame.lines
        if name in lines:
            frame.key = name
            raise self._error(line, f"{spell(self._path())}: already given on line {lines[name]}")
        lines[name] = line
        frame.key = key

    def _sources(self, value: object, line: int) -> list[dict[str, Any]]:
        sources: list[Any] = value if isinstance(value, list) else [value]
        if not all(isinstance(source, dict) for source in sources):
            raise self._error(
                line, f"<< in {self._place()} is {show(value)}: expected a map to merge"
            )
        return sources

    def _expects_key(self) -> bool:
        frame = self._open[-1] if self._open else None
        return frame is not None and isinstance(frame.value, dict) and frame.key is None

    def _path(self) -> tuple[Key, ...]:
        keys = [frame.position() for frame in self._open]
        return tuple("<<" if key is _MERGE else key for key in keys if key is not None)

    def _place(self) -> str:
        return spell(tuple(key for key in self._path() if key != "<<"))

    def _count(self, line: int) -> None:
        # The size of a map or list counts only once it ends; this also bounds what is still open.
        self._values += 1
        if self._values > MOST_VALUES:
            raise self._too_many(line)

    def _too_many(self, line: int) -> SceneError:
        return self._error(
            line, f"more than {MOST_VALUES:,} values with all aliases written out: too many"
        )

    def _check_depth(self, height: int, line: int) -> None:
        if len(self._open) + height > DEEPEST:
            raise self._error(line, _TOO_DEEP)

    def _error(self, line: int, message: str) -> SceneError:
        return SceneError(f"{self.file}:{line}: {message}")


def _container(value: object) -> str:
    return "a list" if isinstance(value, list) else "a map"


_NOT_TEXT = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_SCENE_KEYS = "keys such as camera, materials, lights and objects"
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def read_document(path: Path, what: str = "scene") -> Document:
    """Read a YAML file; `what` is what it describes, for messages.

    Raises SceneError for a file that is missing, unreadable, too large, not UTF-8 or not YAML, and for YAML that
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
        return read_input(path, f"{what} file", InputLimit(LARGEST_SCENE), SceneError)
    except SceneError as error:
        if isinstance(error.__cause__, FileNotFoundError):
            raise SceneError(f"{error}{_near(path)}") from None
        raise


def _elsewhere() -> str:
    """What to do where the current folder is none of the course; empty where it has scenes."""
    if CHECKOUT or Path("scenes").is_dir():
        return ""
    return f": {begin()}"


def _near(path: Path) -> str:
    """Which file may be meant: beside it, or in a folder `scenes` there, or beside the folder where notebooks are."""
    if not path.parent.is_dir():
        return f"; its folder is missing too{_elsewhere()}"
    found: dict[str, Path] = {}
    for folder in (path.parent, path.parent / "scenes", path.parent / ".." / "scenes"):
        # A folder that can't be read has nothing to tell.
        with suppress(OSError):
            for entry in sorted(folder.iterdir()):
                if entry.suffix in {".yaml", ".yml"}:
                    found.setdefault(entry.name, entry)
    known = found.get(path.name) or found.get(f"{path.name}.yaml")
    near = get_close_matches(path.name[:LONGEST], found, n=1, cutoff=0.6)
    known = known or (found[near[0]] if near else None)
    return f"; did you mean {shown(known)}?" if known else ""


def _decode(content: bytes, file: str) -> str:
    try:
        text = text_of(content)
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise SceneError(
            f"{file}:{line}: not {error.encoding.upper()} text: byte {error.start} is 0x{content[error.start]:02x};"
            " save it as UTF-8"
        ) from None
    if found := _NOT_TEXT.search(text):
        line = text.count("\n", 0, found.start()) + 1
        raise SceneError(f"{file}:{line}: not text: character U+{ord(found.group()):04X}")
    return text


def _not_yaml(error: yaml.MarkedYAMLError, text: str, file: str) -> SceneError:
    mark = error.problem_mark or error.context_mark
    line = mark.line + 1 if mark else 1
    if error.problem and "nesting depth" in error.problem:
        # PyYAML 6.0.4 has a limit of its own, and reads ahead of what the tree is built of.
        return SceneError(f"{file}:{line}: {_TOO_DEEP}")
    message = f"{file}:{line}: not valid YAML: {error.problem or error.context}"
    if error.problem and error.context and error.context_mark:
        message += f", {error.context} that starts on line {error.context_mark.line + 1}"
    lines = text.splitlines()
    if line <= len(lines) and "\t" in lines[line - 1]:
        message += " (YAML is indented with spaces, not tabs)"
    return SceneError(message)


def _kind(value: object) -> str:
    return "a list" if isinstance(value, list) else f"just {show(value)}"
