"""Files that appear under their name only when they are whole.

What is written goes to a hidden file in the same folder, which then takes the name in one step of
the file system; after a failure, or Ctrl-C, neither remains.
"""

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from course.base.errors import OutputError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give the name of an empty temporary file that becomes `path` when the block ends well.

    Raises OutputError: the folder isn't there or can't be written, `path` isn't a regular file, or an OSError escaped
    from the block (a full disk).
    ``path``: the name to appear; a file that has it already is replaced. Symbolic links are followed.
    Yields the file to write, in the same folder and with the same suffix.
    """
    target = _target(path)
    temporary = _reserve(path, target)
    try:
        yield temporary
        temporary.replace(target)
    except OSError as error:
        raise OutputError(f"{path}: can't be written: {_reason(error)}") from error
    finally:
        temporary.unlink(missing_ok=True)


def check_writable(path: Path) -> None:
    """Find out before the work whether `replacing(path)` can succeed.

    Raises OutputError as `replacing` would.
    ``path``: the file that is going to be written. It stays as it is.
    """
    _reserve(path, _target(path)).unlink()


def make_folder(folder: Path) -> None:
    """Make a folder that is to be filled, and those above it; OutputError if it can't be made."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: this folder can't be made: {error.strerror}") from error


def write_text(path: Path, text: str) -> None:
    """Write a UTF-8 text file, whole or not at all.

    Raises OutputError as `replacing` does.
    """
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_rows(path: Path, data: Any, depth: int) -> None:
    """Write JSON whose objects and arrays are spread over lines, but those `depth` deep: each of them is one line.

    Raises OutputError as `replacing` does.
    """
    write_text(path, f"{_spread(data, depth, '')}\n")


def _spread(data: Any, depth: int, indent: str) -> str:
    if depth == 0 or not data or not isinstance(data, dict | list | tuple):
        return json.dumps(data)
    inner = f"{indent} "
    if isinstance(data, dict):
        rows = [f"{json.dumps(k)}: {_spread(one, depth - 1, inner)}" for k, one in data.items()]
        start, end = "{}"
    else:
        rows, (start, end) = [_spread(one, depth - 1, inner) for one in data], "[]"
    text = f",\n{inner}".join(rows)
    return f"{start}\n{inner}{text}\n{indent}{end}"


def _target(path: Path) -> Path:
    """Follow symbolic links, and refuse what must not be replaced by a file, such as a device."""
    try:
        target = path.resolve()
        refused = target.exists() and not target.is_file()
    except (OSError, RuntimeError) as error:  # Python 3.11 reports circular links by RuntimeError
        raise OutputError(f"{path}: can't be written: {error}") from error
    if refused:
        kind = "a folder" if target.is_dir() else "not a regular file"
        raise OutputError(f"{path}: can't be written, because it is {kind}")
    return target


def _reserve(path: Path, target: Path) -> Path:
    """Create the temporary file: the only sure way to learn that a folder can be written."""
    folder = target.parent
    temporary = folder / f".course-{os.urandom(4).hex()}.tmp{target.suffix}"
    try:
        temporary.touch(exist_ok=False)
    except OSError as error:
        if not folder.exists():
            trouble = (
                f"there is no folder {folder if path.is_symlink() else path.parent}: make it first"
            )
        elif not folder.is_dir():
            trouble = f"{path.parent} is not a folder"
        else:
            trouble = f"the folder {path.parent} can't be written ({_reason(error)})"
        raise OutputError(f"{path}: can't be written: {trouble}") from error
    return temporary


def _reason(error: OSError) -> str:
    return (error.strerror or str(error) or type(error).__name__).lower()
