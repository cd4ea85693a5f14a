"""Where submissions come from: folders and zip files that nobody trusts.

Only files with the names of modules are taken, wherever in the submission they lie; everything else in it is left
alone. Nothing is unpacked to the disk, so no path can lead out and no link can be followed.
"""

from __future__ import annotations

import os
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path, PurePosixPath

from course.effects import COURSE
from course.errors import CourseError
from course.grading.errors import StudentError, meant

LARGEST_FILE = 2_000_000
"""Bytes of one file that are read; the worker refuses less than that, with a message of its own."""

MOST_ENTRIES = 2000
MOST_BYTES = 200_000_000
"""Of a zip file, unpacked."""


class SubmissionError(CourseError):
    """A submission that can't be graded; the message names it and says why."""


def read_submission(path: Path, modules: Iterable[str] = tuple(COURSE)) -> dict[str, bytes]:
    """Modules of a folder or a zip file.

    Parameters
    ----------
    modules : only these are looked at

    Raises
    ------
    SubmissionError
        It holds links or paths that lead out, is too large, is damaged, holds two files for one module, or can't be
        read for whatever other reason.
    """
    return read_zip(path, modules) if path.is_file() else read_folder(path, modules)


def why_absent(
    module: str, source: bytes | None, folder: Path | None = None
) -> StudentError | None:
    """Why there is nothing to check in a module; None if there is.

    Parameters
    ----------
    source : the file; None where there is none
    folder : where it should be, which is told with it; None if that is nobody's business
    """
    path = Path(f"{module}.py") if folder is None else folder / f"{module}.py"
    if source is None:
        return StudentError(
            "missing", f"{path} is missing{_meant(module, folder)}", module_wide=True
        )
    if not source.strip():
        return StudentError("missing", f"{path} is empty", module_wide=True)
    return None


def _meant(module: str, folder: Path | None) -> str:
    """Which other file of the folder may be meant to be the module."""
    files = [] if folder is None else sorted(folder.glob("*.py"))
    near = meant(module, (file.stem for file in files if file.stem not in COURSE))
    return f" (is it {near}.py?)" if near else ""


def find_modules(folder: Path, modules: Iterable[str] = tuple(COURSE)) -> dict[str, Path]:
    """Where the files of modules are: in a folder, or else below it; a module that isn't there is left out.

    Raises
    ------
    SubmissionError
        One isn't in the folder, and more than once below it; or the folder can't be read.
    """
    found: dict[str, Path] = {}
    for module in modules:
        top = folder / f"{module}.py"
        with _readable(folder):
            # A file at the top is meant, whatever lies deeper.
            paths = [top] if os.path.lexists(top) else _below(folder, top.name)
        if len(paths) > 1:
            raise SubmissionError(
                f"{folder}: {module}.py is in it more than once: {_listed(paths)}"
            )
        if paths:
            found[module] = paths[0]
    return found


def _below(folder: Path, name: str) -> list[Path]:
    return sorted(path for path in folder.rglob(name) if "__MACOSX" not in path.parts)


def read_folder(folder: Path, modules: Iterable[str] = tuple(COURSE)) -> dict[str, bytes]:
    """Modules in a folder or below.

    Parameters
    ----------
    modules : only these are looked at

    Raises
    ------
    SubmissionError
        One is a link, is no file, lies twice in it, or can't be read.
    """
    return read_found(folder, find_modules(folder, modules))


def read_found(folder: Path, paths: Mapping[str, Path]) -> dict[str, bytes]:
    """Modules that `find_modules` has found in a folder; raises what `read_folder` does."""
    found: dict[str, bytes] = {}
    with _readable(folder):
        for module, path in paths.items():
            if path.is_symlink() or not path.resolve().is_relative_to(folder.resolve()):
                raise SubmissionError(f"{path}: is a link; submit the file itself")
            if not path.is_file():
                # To open a pipe would wait for somebody to write to it.
                raise SubmissionError(f"{path}: is no ordinary file")
            with path.open("rb") as file:
                found[module] = file.read(LARGEST_FILE)
    return found


@contextmanager
def _readable(folder: Path) -> Iterator[None]:
    """What the system can't read is told as a mistake of the submission."""
    try:
        yield
    except OSError as error:
        raise SubmissionError(
            f"{error.filename or folder}: can't be read: {error.strerror}"
        ) from error


def read_zip(path: Path, modules: Iterable[str] = tuple(COURSE)) -> dict[str, bytes]:
    """Modules in a zip file.

    Parameters
    ----------
    modules : only these are looked at

    Raises
    ------
    SubmissionError
        As by ``read_submission``.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            return _read_zip(path, archive, set(modules))
    except SubmissionError:
        raise
    except Exception as error:
        # The ways in which a zip file can be damaged have no common class.
        raise SubmissionError(f"{path}: is no zip file that can be read: {error}") from error


def _read_zip(path: Path, archive: zipfile.ZipFile, modules: set[str]) -> dict[str, bytes]:
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
        if name.suffix != ".py" or module not in modules or "__MACOSX" in name.parts:
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
