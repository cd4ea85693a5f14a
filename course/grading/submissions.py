"""Where submissions come from: folders and zip files that nobody trusts.

Only files with the names of modules are taken, wherever in the submission they lie; everything else in it is left
alone. Nothing is unpacked to the disk, so no path can lead out and no link can be followed.
"""

from __future__ import annotations

import zipfile
from pathlib import Path, PurePosixPath

from course.effects import COURSE
from course.errors import CourseError

LARGEST_FILE = 2_000_000
"""Bytes of one file that are read; the worker refuses less than that, with a message of its own."""

MOST_ENTRIES = 2000
MOST_BYTES = 200_000_000
"""Of a zip file, unpacked."""


class SubmissionError(CourseError):
    """A submission that can't be graded; the message names it and says why."""


def read_submission(path: Path) -> dict[str, bytes]:
    """The modules of a folder or a zip file.

    Raises
    ------
    SubmissionError
        It holds links or paths that lead out, is too large, is damaged, holds two files for one module, or can't be
        read for whatever other reason.
    """
    return read_zip(path) if path.is_file() else read_folder(path)


def read_folder(folder: Path) -> dict[str, bytes]:
    """The modules in a folder or below.

    Raises
    ------
    SubmissionError
        One is a link, is no file, lies twice in it, or can't be read.
    """
    try:
        return _read_folder(folder)
    except OSError as error:
        raise SubmissionError(
            f"{error.filename or folder}: can't be read: {error.strerror}"
        ) from error


def _read_folder(folder: Path) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    for module in COURSE:
        paths = sorted(
            path for path in folder.rglob(f"{module}.py") if "__MACOSX" not in path.parts
        )
        # A file at the top is meant, whatever lies deeper.
        paths = [path for path in paths if path.parent == folder] or paths
        if len(paths) > 1:
            raise SubmissionError(
                f"{folder}: {module}.py is in it more than once: {_listed(paths)}"
            )
        for path in paths:
            if path.is_symlink() or not path.resolve().is_relative_to(folder.resolve()):
                raise SubmissionError(f"{path}: is a link; submit the file itself")
            if not path.is_file():
                # To open a pipe would wait for somebody to write to it.
                raise SubmissionError(f"{path}: is no ordinary file")
            with path.open("rb") as file:
                found[module] = file.read(LARGEST_FILE)
    return found


def read_zip(path: Path) -> dict[str, bytes]:
    """The modules in a zip file.

    Raises
    ------
    SubmissionError
        As by ``read_submission``.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            return _read_zip(path, archive)
    except SubmissionError:
        raise
    except Exception as error:
        # The ways in which a zip file can be damaged have no common class.
        raise SubmissionError(f"{path}: is no zip file that can be read: {error}") from error


def _read_zip(path: Path, archive: zipfile.ZipFile) -> dict[str, bytes]:
    entries = archive.infolist()
    if len(entries) > MOST_ENTRIES or sum(entry.file_size for entry in entries) > MOST_BYTES:
        raise SubmissionError(f"{path}: is too large to be a submission")
    chosen: dict[str, zipfile.ZipInfo] = {}
    depth: dict[str, int] = {}
    for entry in entries:
        name = PurePosixPath(entry.filename.replace("\\", "/"))
        if name.is_absolute() or ".." in name.parts or ":" in name.parts[0]:
            raise SubmissionError(f"{path}: {entry.filename!r} leads out of the archive")
        if (entry.external_attr >> 28) == 0xA:
            raise SubmissionError(f"{path}: {entry.filename!r} is a link; submit the file itself")
        module = name.stem
        if name.suffix != ".py" or module not in COURSE or "__MACOSX" in name.parts:
            continue
        if module in chosen and len(name.parts) == depth[module]:
            raise SubmissionError(f"{path}: {module}.py is in it more than once")
        if module not in chosen or len(name.parts) < depth[module]:
            chosen[module], depth[module] = entry, len(name.parts)
    found = {}
    for module, entry in chosen.items():
        with archive.open(entry) as file:
            # What the directory says of sizes may be a lie: no more than this is unpacked.
            found[module] = file.read(LARGEST_FILE)
    return found


def _listed(paths: list[Path]) -> str:
    return ", ".join(str(path) for path in paths[:3])
