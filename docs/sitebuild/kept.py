"""Files that builds keep: those that no page uses any more are removed."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


def forget_unused(folder: Path, used: Iterable[Path]) -> list[Path]:
    """Remove from a folder what isn't used.

    Parameters
    ----------
    used : files that pages show; what has the same name and another suffix, such as a receipt, belongs to them

    Returns
    -------
    The files that were removed.
    """
    names = {path.stem for path in used if path.parent == folder}
    unused = [
        path for path in sorted(folder.glob("*")) if path.is_file() and path.stem not in names
    ]
    for path in unused:
        path.unlink()
    return unused
