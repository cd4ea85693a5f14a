"""Where on the site a generated part stands, and the files that it brings."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Place:
    """A page that is being expanded.

    Attributes
    ----------
    up : from the page's folder to the site's, "" or "../"
    blank : whether the build must not wait for pictures, and shows grey ones
    made : folder of what this build makes and nobody keeps
    files : of the whole site, from address to the file that is copied there
    """

    up: str
    blank: bool
    made: Path
    files: dict[str, Path]

    def address(self, target: str, file: Path) -> str:
        """Have the file copied to ``target``, as the site sees it; return its address, as the page sees it."""
        self.files[target] = file
        return f"{self.up}{target}"
