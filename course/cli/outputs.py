"""The files that a command is asked to write, looked at before any work is done.

The rule for all commands: a file goes into a folder that is there, for a folder that isn't is most likely a slip of the
pen. A folder is made only where a command is asked to fill one, as by `demo --out` or `bench --plots`. No two outputs
are one file, and none is a file that is read.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING

from course.base.atomic import check_writable
from course.base.errors import OutputError

if TYPE_CHECKING:
    from course.engine.formats.yaml.loading import Loaded

Named = tuple[str, Path | None]
"""The option for an output, such as -o, and its path; None where it isn't asked for."""


def check_outputs(
    pictures: Sequence[Named] = (), files: Sequence[Named] = (), source: Path | None = None
) -> None:
    """Find out before the work whether all outputs can be written, without one replacing another or the source.

    Raises OutputError: names the option and the path: a suffix that no picture has, a folder that isn't there or can't
    be written, or one file for two purposes, however it is spelled.

    Parameters
    ----------
    pictures : .png or .exr
    files : of any other kind
    source : the file that the command reads
    """
    check_distinct((*pictures, *files), source)
    for _, path in pictures:
        if path is not None:
            # With the picture formats comes NumPy, which other commands don't need yet.
            from course.engine.formats.pictures.files import check_picture_path

            check_picture_path(path)
    for _, path in files:
        if path is not None:
            check_writable(path)


def check_distinct(outputs: Sequence[Named], source: Path | None = None) -> None:
    """The part of `check_outputs` for which no folder has to be there yet.

    Raises OutputError: two outputs are one file, or one is the source.
    """
    given = [(name, path) for name, path in outputs if path is not None]
    for name, path in given:
        if source is not None and is_same_file(path, source):
            raise OutputError(
                f"{name} {path}: this is the file that is read, and would be replaced: give another name"
            )
    for (name, path), (other, twin) in combinations(given, 2):
        if is_same_file(path, twin):
            raise OutputError(
                f"{name} {path} and {other} {twin} are one file: the second would replace the first;"
                " give each a name of its own"
            )


def check_spared(outputs: Sequence[Named], loaded: Loaded) -> None:
    """Raise OutputError where an output is a file that a scene, which has been read, names: a mesh or a picture."""
    # A command that writes one scene's pictures has read it with this module.
    from course.engine.formats.yaml.named_files import named_files

    for name in named_files(loaded.description, loaded.path.parent):
        check_distinct(outputs, loaded.path.parent / name)


def is_same_file(a: Path, b: Path) -> bool:
    """True if two paths lead to one file, which need not exist: by links, by `..`, or in capitals."""
    try:
        # Where file systems pass over capitals, the file that is there tells.
        return _spelled(a) == _spelled(b) or (a.exists() and b.exists() and a.samefile(b))
    except (OSError, RuntimeError, ValueError):  # links in a circle, or no path at all
        return False


def _spelled(path: Path) -> str:
    return os.path.normcase(path.resolve())
