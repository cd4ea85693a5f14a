"""How the name of a METU scene file ends; commands look at it before they import what reads one."""

from pathlib import Path
from typing import Final

SUFFIXES: Final = (".xml", ".json")


def is_metu(path: Path) -> bool:
    """Whether a file's name is that of a METU scene."""
    return path.suffix.lower() in SUFFIXES
