"""Loops that Numba has compiled are kept on disk; those that are older than a source beside them are compiled anew."""

from contextlib import suppress
from pathlib import Path


def forget_older_loops(folder: Path) -> None:
    """Delete what is older than any source of a folder; Numba looks at a loop's own file only, not at what it calls."""
    newest = max(file.stat().st_mtime for file in folder.glob("*.py"))
    for index in (folder / "__pycache__").glob("*.nbi"):
        # Another process may have deleted it, too.
        with suppress(FileNotFoundError):
            if index.stat().st_mtime < newest:
                index.unlink()
