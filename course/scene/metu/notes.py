"""What a conversion has to say: warnings, one for each kind of thing."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from course.scene.metu.element import Element

MOST = 20
"""Warnings that are told one by one."""


@dataclass
class Notes:
    """Warnings in the order in which they arose; those that differ only in a number are told once."""

    _texts: dict[str, tuple[str, int]] = field(default_factory=dict)

    def add(self, element: Element, message: str) -> None:
        """Say something about an element."""
        self._add(element.where, f"{element.path} {message}")

    def add_left_over(self, root: Element) -> None:
        """Name every part of the file that nobody has asked for."""
        for where, path in root.left_over():
            self._add(where, f"{path} is not known, and was left out")

    def texts(self) -> list[str]:
        """All warnings, each with file, line where there is one, and path."""
        told = [
            text + (f" (and {count - 1} more of this kind)" if count > 1 else "")
            for text, count in self._texts.values()
        ]
        more = len(told) - MOST
        return told[:MOST] + ([f"... and {more} more kinds of warnings"] if more > 0 else [])

    def _add(self, where: str, message: str) -> None:
        kind = re.sub(r"\[\d+\]", "", message)
        text, count = self._texts.get(kind, (f"{where}: {message}", 0))
        self._texts[kind] = (text, count + 1)
