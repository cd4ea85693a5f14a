"""One element of a METU scene file, which knows which of its parts have been asked for; and warnings about elements."""

import math
import re
from collections.abc import Container, Iterator
from dataclasses import dataclass, field

import numpy as np

from course.base.errors import SceneError
from course.engine.core.types import Floats64
from course.engine.formats.metu.refusals import refuse
from course.engine.formats.yaml.document import show
from course.engine.formats.yaml.tree import LARGEST, SMALLEST


@dataclass
class MetuElement:
    """A tag with attributes, text and children; what nobody has asked for is left over at the end.

    Attributes
    ----------
    tag : its name
    path : of tags from the root, such as Scene/Cameras/Camera[2]
    where : file and line, or the file alone
    plain : in JSON, whether it is a value of its own, not a map
    """

    tag: str
    path: str
    where: str
    attributes: dict[str, str] = field(default_factory=dict)
    children: "list[MetuElement]" = field(default_factory=list)
    text: str = ""
    plain: bool = False
    _asked: set[str] = field(default_factory=set)
    _text_asked: bool = False

    def error(self, message: str) -> SceneError:
        """An error about this element: `box.xml:7: Scene/Lights/PointLight[1]: MESSAGE`."""
        return SceneError(f"{self.where}: {self.path}: {message}")

    def unexpected(self, expected: str) -> SceneError:
        """An error about its text."""
        text = " ".join(self.text[:200].split())
        return SceneError(f"{self.where}: {self.path} is {show(text)}: expected {expected}")

    def refused(self, why: str) -> SceneError:
        """An error about something that is known, and can't be converted."""
        return SceneError(f"{self.where}: {self.path} is refused: {why}")

    def attribute(self, name: str) -> str | None:
        """An attribute's value, None where it isn't given."""
        self._asked.add(name)
        value = self.attributes.get(name)
        return None if value is None else value.strip()

    def id(self, taken: Container[str] = ()) -> str:
        """The attribute `id`; SceneError where it is missing, or one of those that are taken."""
        name = self.attribute("id")
        if not name:
            self._check_map()
            raise self.error('id is missing: expected an attribute such as id="1"')
        if name in taken:
            raise self.error(f"its id is given twice: expected another than {name}")
        return name

    def flag(self, name: str) -> bool:
        """An attribute that is true or false, false where it isn't given."""
        value = (self.attribute(name) or "false").lower()
        if value not in {"true", "false", "1", "0"}:
            raise self.error(f"{name} is {show(value)}: expected true or false")
        return value in {"true", "1"}

    def all(self, tag: str) -> "list[MetuElement]":
        """The children of that name; SceneError for a number or a text in JSON where children could be."""
        self._asked.add(tag)
        if self.text.strip():
            self._check_map()
        return [child for child in self.children if child.tag == tag]

    def maybe(self, tag: str) -> "MetuElement | None":
        """The child of that name, if there is one; SceneError for several."""
        found = self.all(tag)
        if len(found) > 1:
            raise found[1].error(f"there are {len(found)} of it: expected one")
        return found[0] if found else None

    def child(self, tag: str, example: str) -> "MetuElement":
        """The child of that name; SceneError where it is missing.

        ``example``: what it is to be, or "such as" and an example of its text
        """
        found = self.maybe(tag)
        if found is None:
            self._check_map()
            named = "an element of that name, " if example.startswith("such as") else ""
            raise self.error(f"{tag} is missing: expected {named}{example}")
        return found

    def _check_map(self) -> None:
        """SceneError for a value of JSON where something with parts is needed; nothing else is missing there."""
        if self.plain:
            raise self.unexpected("a map of its attributes and elements")

    def words(self) -> list[str]:
        """Its text, split at blanks."""
        self._text_asked = True
        return self.text.split()

    def numbers(self, count: int, example: str) -> tuple[float, ...]:
        """Its text as that many finite numbers."""
        expected = f"{'1 number' if count == 1 else f'{count} numbers'}, such as {example}"
        values = self.many(expected)
        if len(values) != count:
            raise self.unexpected(expected)
        return tuple(values.tolist())

    def vector(self) -> tuple[float, ...]:
        """Its text as three numbers."""
        return self.numbers(3, "0 1 -2.5")

    def color(self, most: float = math.inf) -> tuple[float, ...]:
        """Its text as red, green and blue, from 0 to a bound."""
        values = self.numbers(3, "1 0.5 0")
        if not all(0 <= value <= most for value in values):
            bound = f" to {most:g}" if most < math.inf else ""
            raise self.unexpected(f"3 numbers from 0{bound}")
        return values

    def direction(self, expected: str = "a direction that is not 0 0 0") -> Floats64:
        """Its text as three numbers, (3,), that are not all 0."""
        direction = np.array(self.vector())
        if not direction.any():
            raise self.unexpected(expected)
        return direction

    def number_of(self, tag: str, default: float) -> float:
        """The text of a child as one number from 0 on; the default where there is none."""
        found = self.maybe(tag)
        return default if found is None else found.number(0)

    def color_of(self, tag: str) -> list[float]:
        """The text of a child as red, green and blue from 0 on; black where there is none."""
        found = self.maybe(tag)
        return [0.0, 0.0, 0.0] if found is None else list(found.color())

    def number(self, least: float, above: bool = False) -> float:
        """Its text as one number, not below (or only ``above``) a bound."""
        (value,) = self.numbers(1, "1.5")
        if value < least or (above and value == least):
            raise self.unexpected(f"a number {'>' if above else '>='} {least:g}")
        return value

    def whole(self, least: int) -> int:
        """Its text as a whole number, not below a bound."""
        (value,) = self.numbers(1, "4")
        if value != math.floor(value) or value < least:
            raise self.unexpected(f"a whole number >= {least}")
        return int(value)

    def many(self, expected: str) -> Floats64:
        """Its text as any number of finite numbers, (n,) float64."""
        try:
            values = np.array(self.words(), np.float64)
        except ValueError:
            raise self.unexpected(expected) from None
        if not np.isfinite(values).all() or (np.abs(values) > LARGEST).any():
            raise self.unexpected(f"{expected}, finite and up to {LARGEST:g} in size")
        # As good as zero, and YAML would refuse it.
        values[np.abs(values) < SMALLEST] = 0
        return values

    def left_over(self) -> Iterator[tuple[str, str]]:
        """File and line, and the path, of every part that nobody has asked for."""
        for name in self.attributes:
            if name not in self._asked:
                yield self.where, f"{self.path}, attribute {name}"
        if self.text.strip() and not self._text_asked:
            yield self.where, f"{self.path}, its text {show(' '.join(self.text[:200].split()))}"
        for child in self.children:
            if child.tag in self._asked:
                yield from child.left_over()
            else:
                yield child.where, child.path


MOST = 20
"""Warnings that are told one by one; the others are told together, by what they say."""


@dataclass
class _Kind:
    """What the first of a kind is about, what is said of it, and how many there are."""

    where: str
    path: str
    message: str
    count: int = 0


@dataclass
class Notes:
    """Warnings in the order in which they arose; those that differ only in a number are told once."""

    _kinds: dict[str, _Kind] = field(default_factory=dict)

    def add(self, element: MetuElement, message: str) -> None:
        """Say something about an element."""
        self._add(element.where, element.path, message)

    def add_left_over(self, root: MetuElement) -> None:
        """Name every part of the file that nobody has asked for; SceneError where one is refused."""
        refuse(root.left_over())
        for where, path in root.left_over():
            self._add(where, path, "is not known, and was left out")

    def texts(self) -> list[str]:
        """All warnings: the first with file, line where there is one, and path, the others with their paths."""
        kinds = list(self._kinds.values())
        told = [
            f"{kind.where}: {kind.path} {kind.message}"
            + (f" (and {kind.count - 1} more of this kind)" if kind.count > 1 else "")
            for kind in kinds[:MOST]
        ]
        alike: dict[str, list[str]] = {}
        for kind in kinds[MOST:]:
            times = f" ({kind.count} times)" if kind.count > 1 else ""
            alike.setdefault(kind.message, []).append(kind.path + times)
        return told + [
            f"... and more that {message}: {', '.join(paths)}" for message, paths in alike.items()
        ]

    def _add(self, where: str, path: str, message: str) -> None:
        kind = re.sub(r"\[\d+\]", "", f"{path} {message}")
        self._kinds.setdefault(kind, _Kind(where, path, message)).count += 1
