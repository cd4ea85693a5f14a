"""What a conversion has to say: warnings, one for each kind of thing."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from course.formats.metu.element import Element

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

    def add(self, element: Element, message: str) -> None:
        """Say something about an element."""
        self._add(element.where, element.path, message)

    def add_left_over(self, root: Element) -> None:
        """Name every part of the file that nobody has asked for."""
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
