"""The endings of METU scene files; commands check them before they import the reader."""

from pathlib import Path
from typing import Final

SUFFIXES: Final = (".xml", ".json")


def is_metu(path: Path) -> bool:
    """True if a file's name is that of a METU scene."""
    return path.suffix.lower() in SUFFIXES
